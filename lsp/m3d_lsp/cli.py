"""`m3d-lsp`: starts the language server."""

from __future__ import annotations

import argparse
import logging
import os
import sys
from collections.abc import Sequence
from typing import TYPE_CHECKING, NoReturn

from m3dc_command import ended, undisturbed
from m3dc_command import parser as command_parser

if TYPE_CHECKING:
    from .server import Server

# How long one thread may keep the others waiting: what is long work to the server is a blink to a person.
SWITCH_INTERVAL_S = 0.001


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the server until its client leaves. Returns the exit status: 0 where the client shut it down first, as LSP
    wants it."""
    return ended("m3d-lsp", lambda: _run(_parser(), arguments))


def _parser() -> argparse.ArgumentParser:
    parser = command_parser(
        "m3d-lsp",
        "m3d-lsp",
        description="Language server for Mirage3D scenes.",
        epilog="Exit status: 0 fine, 1 ended without a shutdown request, 2 usage or files, 130 interrupted.",
    )
    parser.add_argument("--stdio", action="store_true", help="talk over standard input and output (the default)")
    parser.add_argument("--tcp", metavar="[HOST:]PORT", help="listen on a port instead, for one client")
    parser.add_argument("--log-file", metavar="FILE", help="append what happens to a file")
    parser.add_argument("--log-level", choices=["debug", "info", "warning", "error"], default="info")
    return parser


def _run(parser: argparse.ArgumentParser, arguments: Sequence[str] | None) -> int:
    options = parser.parse_args(arguments)
    if options.stdio and options.tcp:
        parser.error("--stdio and --tcp exclude each other")
    address = ("127.0.0.1", 0)
    if options.tcp:
        host, _, port = options.tcp.rpartition(":")
        if not port.isdecimal() or int(port) > 65535:
            parser.error(f"--tcp takes a port, or host:port, not {options.tcp!r}")
        address = (host or "127.0.0.1", int(port))
    try:
        _log_to(options.log_file, options.log_level)
    except OSError as error:
        print(f"m3d-lsp: can not write {options.log_file}: {error.strerror}", file=sys.stderr)
        return 2

    sys.setswitchinterval(SWITCH_INTERVAL_S)
    server = undisturbed(_server)
    if options.tcp:
        try:
            server.start_tcp(*address)
        except OSError as error:
            print(f"m3d-lsp: can not listen on {address[0]}:{address[1]}: {error.strerror}", file=sys.stderr)
            return 2
    else:
        server.start_io()
    return server.exit_status


def _server() -> Server:
    from .server import make_server

    return make_server()


def run() -> NoReturn:
    """The command. Threads that still work need not be waited for: what they find nobody reads."""
    status = main()
    logging.shutdown()
    sys.stderr.flush()
    os._exit(status)


def _log_to(file: str | None, level: str) -> None:
    """Without a file only warnings are written, to standard error. Raises OSError if the file can not be written."""
    handler = logging.FileHandler(file, encoding="utf-8") if file else logging.StreamHandler(sys.stderr)
    handler.setFormatter(logging.Formatter("%(asctime)s %(levelname)s %(name)s: %(message)s"))
    root = logging.getLogger()
    root.addHandler(handler)
    root.setLevel(level.upper() if file else logging.WARNING)
    # What it says of each message is said by our own protocol.
    logging.getLogger("pygls").setLevel(logging.WARNING)
