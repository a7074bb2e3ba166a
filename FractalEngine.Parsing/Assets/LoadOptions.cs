using FractalEngine.Core.Fractals;

namespace FractalEngine.Parsing.Assets;

/// <summary>How files are loaded, where that differs from what they say themselves.</summary>
public sealed record LoadOptions
{
    /// <summary>Whether files may name others outside their folder, see <see cref="AssetFolder"/>.</summary>
    public bool AllowOutsideFiles { get; init; }

    /// <summary>The composition of all fractals; null for what each file says.</summary>
    public Composition? Composition { get; init; }

    /// <summary>The depth of all fractals that have one; null for what each file says.</summary>
    public int? Depth { get; init; }

    /// <summary>
    /// Whether meshes and fractals are read once however many objects name them; otherwise once for each, for comparison.
    /// </summary>
    public bool ShareModels { get; init; } = true;
}
