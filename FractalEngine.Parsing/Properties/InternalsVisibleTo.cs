using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("FractalEngine.Tests")]
[assembly: InternalsVisibleTo("FractalEngine.Benchmarks")]
