"""`python -m illuminant` is the command `illuminant`."""

from illuminant.cli import main

if __name__ == "__main__":
    main(prog_name="python -m illuminant")
