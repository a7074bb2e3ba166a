using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Contents of a parsed fractal file, whose base meshes are not loaded yet.</summary>
/// <param name="Source">Text of the file.</param>
/// <param name="Description">What the result makes of base meshes, and its composition.</param>
/// <param name="Bases">What stands for the base meshes, in their order: a file may be another fractal, or be named more than once.</param>
/// <param name="ResultOffset">Offset of the result's declaration in the text, in characters, for messages about the whole fractal.</param>
public sealed record ParsedFractal(
    SourceText Source, FractalDescription Description, ImmutableArray<BaseReference> Bases, int ResultOffset)
{
    /// <summary>Name of the first base mesh's file, relative to the fractal file, or one of the <see cref="BaseShapes"/>.</summary>
    public string BaseFile => Bases[0].File;

    /// <summary>Whether sums and sets are those of the text, see <see cref="FractalPartList"/>.</summary>
    internal bool KeepsSums { get; init; }

    /// <summary>How its instances differ in colour where no scene says otherwise; null for not at all.</summary>
    public Gradient? Gradient { get; init; }

    /// <summary>How the coordinates are shown where the fractal is opened alone; null for as in the paper.</summary>
    public Handedness? Handedness { get; init; }

    /// <summary>Names of the numbers that the file declares, in their order.</summary>
    public ImmutableArray<string> NumberNames { get; init; } = [];

    /// <summary>Hints about declarations that are valid but hardly meant so, such as radians in place of degrees.</summary>
    public ImmutableArray<Diagnostic> Warnings { get; init; } = [];
}
