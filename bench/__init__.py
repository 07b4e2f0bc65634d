"""Benchmarks: our compiler and renderer beside the programs one would otherwise use, measured in one run.

python -m bench                      all rows of the table, about five minutes
python -m bench --only compile       the rows whose name has "compile" in it
python -m bench --write docs/performance.md
"""
