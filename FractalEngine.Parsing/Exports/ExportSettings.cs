using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;

namespace FractalEngine.Parsing.Exports;

/// <summary>What an export is asked for, whatever its format.</summary>
public sealed record ExportSettings
{
    /// <summary>Largest number of faces that may be written, each instance's counted.</summary>
    public long MaxFaces { get; init; } = FractalLimits.ExportedFaces.Value;

    /// <summary>Whether each instance is written by itself, also where the format can keep levels.</summary>
    public bool IsFlat { get; init; }

    /// <summary>The most instances in the whole scene: the largest parts are divided until there would be more. Null for all.</summary>
    public long? MaxInstances { get; init; }

    /// <summary>The handedness of the file's coordinates; null for what its format has.</summary>
    public Handedness? Handedness { get; init; }

    /// <summary>The axis of the file that points up; null for what its format has.</summary>
    public UpAxis? Up { get; init; }

    /// <summary>Length of a scene unit in the file, in millimetres or whatever its unit is; null for 1.</summary>
    public double? UnitLength { get; init; }

    /// <summary>Height of the whole scene in the file, in its unit, which decides the length of a scene unit; null for none.</summary>
    public double? Height { get; init; }

    /// <summary>How the scene's files were loaded, for formats that load them again at other values of their numbers.</summary>
    public LoadOptions Load { get; init; } = new();

    /// <summary>Told the written part of the file, from 0 to 1, where its format knows how much there will be; null for nobody.</summary>
    public IProgress<double>? Progress { get; init; }

    /// <summary>Ends the export between two instances, or before a file of levels is written.</summary>
    public CancellationToken Cancellation { get; init; }
}
