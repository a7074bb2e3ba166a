using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Scenes;

/// <summary>A parsed scene file: what it says, and how it says it, so that saving keeps comments and layout.</summary>
/// <param name="Source">The text.</param>
/// <param name="Scene">What it says.</param>
/// <param name="Lines">All lines in order.</param>
public sealed record SceneFile(SourceText Source, Scene Scene, ImmutableArray<SceneLine> Lines)
{
    /// <summary>Where the file name of an object stands in the text, for messages about that file.</summary>
    public int FileOffset(int objectIndex) =>
        Lines.First(line => line.Kind == SceneDeclarationKind.SceneObject && line.Index == objectIndex).FileOffset;
}
