namespace FractalEngine.Tests.Oracles.Graphs;

/// <summary>How a fractal is made of a model.</summary>
internal enum GraphSource
{
    /// <summary>Its files are read.</summary>
    File,

    /// <summary>Its files are read, written by the engine, and read again.</summary>
    WrittenFile,

    /// <summary>It is made by calls of the library.</summary>
    Code,
}
