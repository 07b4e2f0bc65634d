;;; What a person does with a scene in Emacs, and what comes of it, as JSON in the file that $RESULT names.  -*- lexical-binding: t; -*-
;; Run by test_emacs.py.

(require 'json)

(defvar result nil)

(defun note (name value) (push (cons name value) result))

(defun wait-until (what condition)
  (let ((until (time-add nil 20)))
    (while (not (funcall condition))
      (when (time-less-p until nil) (error "%s" what))
      (accept-process-output nil 0.05)))
  t)

(defun go-to (text)
  (goto-char (point-min))
  (search-forward text)
  (goto-char (match-beginning 0)))

(defun swap (old new)
  (go-to old)
  (delete-char (length old))
  (insert new)
  (eglot--signal-textDocument/didChange))

(defun whole () (buffer-substring-no-properties (point-min) (point-max)))

(setq mirage3d-command (json-parse-string (getenv "SERVER") :array-type 'list)
      eglot-sync-connect t
      eglot-confirm-server-initiated-edits nil)
(find-file (getenv "SCENE"))
(note 'mode (symbol-name major-mode))
(unless (eglot-managed-p)
  (apply #'eglot (append (eglot--guess-contact) '(t))))
(flymake-mode 1)

;; Mistakes are shown, and go when they are mended.
(flymake-start)
(wait-until "no diagnostics" (lambda () (flymake-diagnostics)))
(note 'diagnostics (vconcat (mapcar (lambda (each)
                                      (list (cons 'text (flymake-diagnostic-text each))
                                            (cons 'line (line-number-at-pos (flymake-diagnostic-beg each)))))
                                    (flymake-diagnostics))))
(swap "-5" "5")
(wait-until "the diagnostics stay" (lambda () (null (flymake-diagnostics))))

(defun ask (method &rest more)
  (jsonrpc-request (eglot--current-server-or-lose) method
                   (append (eglot--TextDocumentPositionParams) more)))

(go-to "SPHERE")
(note 'hover (plist-get (plist-get (ask :textDocument/hover) :contents) :value))

(swap "RADIUS 5" "RAD RADIUS 5")
(go-to "RAD ")
(forward-char 3)
(let ((capf (eglot-completion-at-point)))
  (note 'completion (vconcat (mapcar #'substring-no-properties (all-completions "RAD" (nth 2 capf))))))
(swap "RAD RADIUS" "RADIUS")

;; M-.
(go-to "red }\nLIGHT")
(let ((places (xref-backend-definitions 'eglot (xref-backend-identifier-at-point 'eglot))))
  (note 'definition (vconcat (mapcar (lambda (each) (xref-location-line (xref-item-location each))) places))))

(eglot-rename "crimson")
(note 'renamed (whole))
(eglot-format-buffer)
(note 'formatted (whole))

(mirage3d-dump)
(defun dump () (with-current-buffer (format "*dump of %s*" (buffer-name)) (whole)))
(wait-until "no dump" (lambda () (string-match-p ": 5.000000" (dump))))
(swap "RADIUS 5" "RADIUS 7")
(note 'dump_follows (wait-until "the dump stays" (lambda () (string-match-p ": 7.000000" (dump)))))

(let ((picture (concat (getenv "RESULT") ".png")))
  (mirage3d-render picture)
  (note 'rendered (wait-until "no picture" (lambda () (file-exists-p picture)))))

(let ((all (json-encode result)))
  (with-temp-file (getenv "RESULT") (insert all)))
