"""`python -m stickiness`: answer on the command line, or open the app."""

import sys

from stickiness import command


def main() -> None:
    """Do what the command line asks."""
    command.run(open_app if "--app" in sys.argv[1:] else command.answer)


def open_app() -> None:
    """Serve the app until Ctrl-C."""
    if len(sys.argv) > 2:
        command.fail("--app takes no file and no other option: give them in its form")
    from stickiness import app

    app.serve()


if __name__ == "__main__":
    main()
