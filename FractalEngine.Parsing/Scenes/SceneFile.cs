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
    /// <summary>
    /// Where the file names of the objects stand in the text, in the order of the objects; for messages about those files.
    /// </summary>
    public IEnumerable<int> FileNameOffsets =>
        Lines.Where(line => line.Kind == SceneDeclarationKind.SceneObject).Select(line => line.FileNameOffset);
}
