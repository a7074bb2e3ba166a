using System.Runtime.CompilerServices;

[assembly: InternalsVisibleTo("FractalEngine.Tests")]
