using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>Options for loading files, which override what the files state.</summary>
public sealed record LoadOptions
{
    /// <summary>Whether files may refer to others outside their folder, see <see cref="AssetFolder"/>.</summary>
    public bool AllowOutsideFiles { get; init; }

    /// <summary>Composition of all fractals; null for what each file states.</summary>
    public Composition? Composition { get; init; }

    /// <summary>
    /// Depth of all fractals that have one, from 0 to <see cref="FractalLimits.Depth"/>; null for what each file states.
    /// </summary>
    public int? Depth { get; init; }

    /// <summary>Seed of all fractals by chance; null for what each file states.</summary>
    public int? Seed { get; init; }

    /// <summary>Values that named numbers of fractals have in place of those that the files give them; finite.</summary>
    public ImmutableDictionary<string, double> Values { get; init; } = ImmutableDictionary<string, double>.Empty;

    /// <summary>
    /// Time of the scene's film, seconds, whose values the named numbers have unless <see cref="Values"/> say otherwise; null for those of
    /// the fractals' files.
    /// </summary>
    public double? FilmTime { get; init; }

    /// <summary>
    /// Text of a scene or fractal that takes the place of the file, whatever its name ends in; null to read the file. A text with a result
    /// <c>&lt;$&gt;</c> is a fractal. Names in it are relative to the folder of the path.
    /// </summary>
    public SourceText? Text { get; init; }

    /// <summary>
    /// Texts of scenes and fractals that were edited and not saved, by their full paths. They take the place of the files. With a cache,
    /// a model counts as unchanged while its text is the same string.
    /// </summary>
    public ImmutableDictionary<string, string> EditedTexts { get; init; } = ImmutableDictionary<string, string>.Empty;

    /// <summary>
    /// Whether a mesh or fractal that is opened alone stands under a sky and a sun, and a fractal without colours of its own has those of
    /// a palette by height. False leaves it to whoever draws it.
    /// </summary>
    public bool IsStaged { get; init; }

    /// <summary>How a mesh or fractal that is opened alone is shown; null for as its file or its format says.</summary>
    public Handedness? Handedness { get; init; }

    /// <summary>
    /// Where a mesh or fractal stands that is opened alone, such as turned for a file whose z axis points up. Elsewhere than at the
    /// identity, camera and lights of its file are left out.
    /// </summary>
    public Transformation Placement { get; init; } = Transformation.Identity;

    /// <summary>Whether all objects of one file share its model. False loads the file once per object, for comparison.</summary>
    public bool ShareModels { get; init; } = true;
}
