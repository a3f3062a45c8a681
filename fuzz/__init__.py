"""Fuzzing: every reader of outside bytes, and the samplers of the core, under inputs that nobody would write.

- `targets`: the readers, what each may raise, and the modules whose coverage is counted;
- `seeds`: the valid files from which all begins; they are kept in `corpus/TARGET`;
- `mutation`: changes to bytes and to texts, the same for the same seed;
- `execution`: one input, and what counts as a finding;
- `lines`: which lines of a module were reached;
- `engine`: one target under atheris (libFuzzer, guided by coverage), or under `mutation` alone;
- `core`: targets in Rust under libFuzzer, on the stable toolchain;
- `run`: the long run by one command.

A reader keeps its promise when it returns, or raises `illuminant.errors.Error` with one sentence. All else is a
finding: another exception, a panic of the core, a warning of NumPy, more than 5 s, more than 1 GB, a number in the
result that is none.
"""
