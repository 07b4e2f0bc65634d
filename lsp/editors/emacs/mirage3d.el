;;; mirage3d.el --- Mirage3D scenes, served by m3d-lsp  -*- lexical-binding: t; -*-

;; Package-Requires: ((emacs "28.1") (eglot "1.9"))

;;; Commentary:

;; (add-to-list 'load-path ".../lsp/editors/emacs")
;; (require 'mirage3d)
;;
;; opens .m3d files in `mirage3d-mode', with Eglot.  Eglot is part of Emacs
;; since version 29; Debian has it for 28 in the package elpa-eglot.

;;; Code:

(require 'eglot)

(defgroup mirage3d nil "Mirage3D scenes." :group 'languages)

(defcustom mirage3d-command '("m3d-lsp")
  "How the language server is started."
  :type '(repeat string))

(defcustom mirage3d-settings nil
  "Settings of the server, as a property list of what is below `m3d':
for instance (:diagnostics (:deny [\"all\"]))."
  :type 'plist)

(defcustom mirage3d-indent-offset 4
  "How many columns a block is indented by."
  :type 'integer)

(defvar mirage3d-mode-syntax-table
  (let ((table (make-syntax-table)))
    (modify-syntax-entry ?/ ". 14n" table)
    (modify-syntax-entry ?* ". 23n" table)
    (modify-syntax-entry ?_ "w" table)
    (modify-syntax-entry ?< "(>" table)
    (modify-syntax-entry ?> ")<" table)
    table)
  "Comments are as in C, and may stand in each other.")

(defvar mirage3d-font-lock-keywords
  '(("\\_<[A-Z][A-Z0-9]*\\_>" . font-lock-keyword-face)
    ("^\\s-*\\([a-z_][A-Za-z0-9_]*\\)\\s-*=" 1 font-lock-variable-name-face)
    ("[-+]?\\_<[0-9]+\\(?:\\.[0-9]+\\)?\\(?:[eE][-+]?[0-9]+\\)?\\_>" . font-lock-constant-face))
  "Keywords of the language are in capitals.")

(defun mirage3d--indentation ()
  "The column that the line at point is to be indented to, as m3dfmt does it.
nil inside a comment, whose lines stay as they are."
  (save-excursion
    (beginning-of-line)
    (let ((state (syntax-ppss)))
      (unless (nth 4 state)
        (let ((depth (seq-count (lambda (open) (eq (char-after open) ?{))
                                (nth 9 state)))
              (closes (looking-at-p "[ \t]*}")))
          (or (and (not closes) (mirage3d--names-column))
              (* mirage3d-indent-offset (max 0 (if closes (1- depth) depth)))))))))

(defun mirage3d--names-column ()
  "Where the names of a declaration begin that goes on in the line at point.
nil if it is none."
  (save-excursion
    (forward-comment (- (point)))
    (when (eq (char-before) ?,)
      (while (progn (beginning-of-line)
                    (save-excursion (forward-comment (- (point)))
                                    (eq (char-before) ?,)))
        (forward-comment (- (point))))
      (when (looking-at "[ \t]*[A-Za-z0-9_]+[ \t]+")
        (goto-char (match-end 0))
        (current-column)))))

(defun mirage3d-indent-line ()
  "Indent the line at point by the blocks that it stands in."
  (let ((column (mirage3d--indentation)))
    (if (null column)
        'noindent
      (if (<= (current-column) (current-indentation))
          (indent-line-to column)
        (save-excursion (indent-line-to column))))))

;;;###autoload
(define-derived-mode mirage3d-mode prog-mode "Mirage3D"
  "Major mode for Mirage3D scenes."
  (setq-local comment-start "/* "
              comment-end " */"
              comment-start-skip "/\\*+\\s-*"
              indent-tabs-mode nil
              indent-line-function #'mirage3d-indent-line
              electric-indent-chars '(?\n ?})
              font-lock-defaults '(mirage3d-font-lock-keywords)
              eglot-workspace-configuration (list :m3d mirage3d-settings))
  (eglot-ensure))

;;;###autoload
(add-to-list 'auto-mode-alist '("\\.m3d\\'" . mirage3d-mode))

(defclass mirage3d-server (eglot-lsp-server) ()
  :documentation "The server of Mirage3D scenes.")

(cl-defmethod eglot-client-capabilities ((_server mirage3d-server))
  "What Eglot can do, and that dumps want to follow their scene."
  (plist-put (cl-call-next-method) :experimental '(:m3d (:analysed t))))

(add-to-list 'eglot-server-programs
             (cons 'mirage3d-mode
                   (lambda (&rest _) (cons 'mirage3d-server mirage3d-command))))

;;; What the server answers beyond LSP (docs/protocol.md)

(defvar-local mirage3d--scene nil "In the buffer of a dump, the scene's.")

(cl-defmethod eglot-handle-notification
  (_server (_method (eql m3d/analysed)) &key uri &allow-other-keys)
  "Fill the dump of the scene at URI anew, if it is shown."
  (when-let ((scene (find-buffer-visiting (eglot--uri-to-path uri))))
    (dolist (buffer (buffer-list))
      (when (eq scene (buffer-local-value 'mirage3d--scene buffer))
        (mirage3d--refresh buffer)))))

(defun mirage3d--refresh (buffer)
  "Fill BUFFER with the dump of its scene."
  (with-current-buffer (buffer-local-value 'mirage3d--scene buffer)
    (jsonrpc-async-request
     (eglot--current-server-or-lose) :m3d/dump
     (list :textDocument (eglot--TextDocumentIdentifier))
     :success-fn
     (lambda (answer)
       (when (buffer-live-p buffer)
         (with-current-buffer buffer
           (let ((inhibit-read-only t) (place (point)))
             (erase-buffer)
             (insert (plist-get answer :text))
             (goto-char (min place (point-max)))
             (setq mode-name
                   (if (eq t (plist-get answer :stale)) "Dump (stale)" "Dump")))))))))

(defun mirage3d-dump ()
  "Show what the scene resolves to, and keep that up to date."
  (interactive)
  (let ((scene (current-buffer))
        (shown (get-buffer-create (format "*dump of %s*" (buffer-name)))))
    (with-current-buffer shown
      (special-mode)
      (setq mirage3d--scene scene))
    (mirage3d--refresh shown)
    (display-buffer shown)))

(defun mirage3d-render (path &optional straight)
  "Render the scene as it stands in the buffer into the picture file PATH.
With a prefix argument STRAIGHT, with straight rays."
  (interactive "FPicture (.png, .exr, .tif): \nP")
  (jsonrpc-async-request
   (eglot--current-server-or-lose) :m3d/preview/save
   (list :textDocument (eglot--TextDocumentIdentifier)
         :optics (if straight "straight" "mirage")
         :path (expand-file-name path))
   :timeout 3600
   :success-fn
   (lambda (answer)
     (message "%s" (or (plist-get answer :message)
                       (format "%s: %s" path (plist-get answer :status)))))))

(provide 'mirage3d)
;;; mirage3d.el ends here
