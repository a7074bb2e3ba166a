using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Contents of a parsed scene file with its original lines, so that saving keeps comments and layout.</summary>
/// <param name="Source">Text of the file.</param>
/// <param name="Scene">Scene that the text declares; its objects have models once they are loaded.</param>
/// <param name="Lines">All lines of the text in order.</param>
public sealed record ParsedScene(SourceText Source, Scene Scene, ImmutableArray<SceneLine> Lines)
{
    /// <summary>Hints about declarations that are valid but hardly meant so, such as degrees in place of radians.</summary>
    public ImmutableArray<Diagnostic> Warnings { get; init; } = [];

    /// <summary>Offsets of the file names of all objects in the text, in the order of the objects.</summary>
    public IEnumerable<int> FileNameOffsets =>
        Lines.Where(line => line.Kind == SceneDeclarationKind.SceneObject).Select(line => line.FileNameOffset);

    /// <summary>Offset of the name of the sky's image in the text; 0 without one.</summary>
    public int SkyNameOffset => Lines.FirstOrDefault(static line => line.Kind == SceneDeclarationKind.Sky)?.FileNameOffset ?? 0;

    /// <summary>Finds where an object, a light or a key is declared: the offset of its first word in the text.</summary>
    /// <param name="index">Index in the scene among those of its kind, from 0.</param>
    /// <param name="kind">Kind of the declaration.</param>
    /// <exception cref="ArgumentOutOfRangeException">The scene has no such declaration.</exception>
    public int DeclarationOffset(int index, SceneDeclarationKind kind = SceneDeclarationKind.SceneObject)
    {
        var offset = 0;
        foreach (var line in Lines)
        {
            if (line.Kind == kind && line.Index == index)
            {
                return offset + line.Characters.Length - line.Characters.Span.TrimStart().Length;
            }

            offset += line.Characters.Length;
        }

        throw new ArgumentOutOfRangeException(nameof(index), index, "the scene has no such declaration");
    }
}
