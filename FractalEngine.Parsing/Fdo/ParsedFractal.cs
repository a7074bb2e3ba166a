using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Contents of a parsed fractal file, whose base mesh is not loaded yet.</summary>
/// <param name="Source">Text of the file.</param>
/// <param name="Description">Steps and composition of the result.</param>
/// <param name="BaseFile">Name of the base mesh's file, relative to the fractal file, or one of the <see cref="BaseShapes"/>.</param>
/// <param name="BaseFileNameOffset">Offset of <see cref="BaseFile"/> in the text, in characters, for messages about the base mesh.</param>
/// <param name="ResultOffset">Offset of the result's declaration in the text, in characters, for messages about the whole fractal.</param>
public sealed record ParsedFractal(
    SourceText Source, FractalDescription Description, string BaseFile, int BaseFileNameOffset, int ResultOffset)
{
    /// <summary>Names of the numbers that the file declares, in their order.</summary>
    public ImmutableArray<string> NumberNames { get; init; } = [];

    /// <summary>Hints about declarations that are valid but hardly meant so, such as radians in place of degrees.</summary>
    public ImmutableArray<Diagnostic> Warnings { get; init; } = [];
}
