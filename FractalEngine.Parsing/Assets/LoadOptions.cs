using FractalEngine.Core.Fractals;

namespace FractalEngine.Parsing.Assets;

/// <summary>Options for loading files, which override what the files state.</summary>
public sealed record LoadOptions
{
    /// <summary>Whether files may refer to others outside their folder, see <see cref="AssetFolder"/>.</summary>
    public bool AllowOutsideFiles { get; init; }

    /// <summary>Composition of all fractals; null for what each file states.</summary>
    public Composition? Composition { get; init; }

    /// <summary>
    /// Depth of all fractals that have one, from 0 to <see cref="FractalLimits.MaxDepth"/>; null for what each file states.
    /// </summary>
    public int? Depth { get; init; }

    /// <summary>Whether all objects of one file share its model. False loads the file once per object, for comparison.</summary>
    public bool ShareModels { get; init; } = true;
}
