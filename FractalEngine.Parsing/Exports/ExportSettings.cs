using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Parsing.Exports;

/// <summary>What an export is asked for, whatever its format.</summary>
public sealed record ExportSettings
{
    /// <summary>Largest number of faces that may be written, each instance's counted.</summary>
    public long MaxFaces { get; init; } = FractalLimits.ExportedFaces.Value;

    /// <summary>Whether each instance is written by itself, also where the format can keep levels.</summary>
    public bool IsFlat { get; init; }

    /// <summary>How the scene's files were loaded, for formats that load them again at other values of their numbers.</summary>
    public LoadOptions Load { get; init; } = new();
}
