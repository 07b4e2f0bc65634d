"""Pictures of open documents, made in a process of their own (docs/protocol.md).

`requests` answers what the client asks, `previews` knows what is being drawn and shown, `process` starts the process
and talks to it. `worker` is that process, with `tiles` and `finished` in it; nothing else imports the renderer, so that
the server starts fast and nothing in the kernel can stop it. `channel` and `messages` are what the two share.
"""
