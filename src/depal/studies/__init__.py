"""The paper's case studies, and the benchmarks of the parts."""
