"""With which status a command ends."""

from collections.abc import Callable, Sequence


def exit_status(main: Callable[[Sequence[str]], int], arguments: Sequence[str]) -> object:
    """What it returns, or says to argparse's way of ending."""
    try:
        return main(arguments)
    except SystemExit as ended:
        return ended.code
