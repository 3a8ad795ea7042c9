"""Types of argparse for the scripts here: what does not fit is said in one line."""
import argparse
import pathlib


def parser(description):
    return argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)


def build_with(*programs):
    """A build folder that holds these programs."""
    def build(text):
        folder = pathlib.Path(text).resolve()
        for program in programs:
            if not (folder / program).is_file():
                raise argparse.ArgumentTypeError(f"{folder / program} is not there; bench/README.md says how to build it")
        return folder
    return build


def program(text):
    path = pathlib.Path(text).resolve()
    if not path.is_file():
        raise argparse.ArgumentTypeError(f"{path} is not there")
    return path


def above_zero(kind):
    """An int or a float."""
    def number(text):
        try:
            value = kind(text)
        except ValueError:
            value = 0
        if not 0 < value < float("inf"):
            raise argparse.ArgumentTypeError(f"{text}: say a {'whole ' if kind is int else ''}number above 0")
        return value
    return number
