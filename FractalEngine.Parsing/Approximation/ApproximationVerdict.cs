using System.Text.Json.Serialization;

namespace FractalEngine.Parsing.Approximation;

/// <summary>What was measured on a fractal that was written for a mesh, and read back.</summary>
public enum ApproximationVerdict
{
    /// <summary>The mesh, within rounding, by recursion.</summary>
    Exact,

    /// <summary>The mesh, within rounding, by sets of maps without recursion.</summary>
    Repeats,

    /// <summary>Closer to the mesh than a simplified mesh of as many bytes.</summary>
    Approximate,

    /// <summary>No fractal was found that is; what is left is the simplified mesh.</summary>
    [JsonStringEnumMemberName("no fractal")]
    NoFractal,
}
