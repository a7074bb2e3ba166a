namespace FractalEngine.Parsing.Sdo;

/// <summary>Line of a scene file in its original form, with what it declares.</summary>
/// <param name="Characters">Part of the file's text, with its line break if it has one.</param>
/// <param name="Kind">Kind of the declaration; null for comments and empty lines.</param>
/// <param name="Index">Index of the light, object or key in the scene, from 0; always 0 for other kinds.</param>
/// <param name="FileNameOffset">
/// Offset of the name of the object's or the sky's file in the text of the whole file; 0 for lines without one.
/// </param>
public sealed record SceneLine(ReadOnlyMemory<char> Characters, SceneDeclarationKind? Kind, int Index, int FileNameOffset)
{
    /// <summary>Text of the line, with its line break if it has one; a new string.</summary>
    public string Text => Characters.ToString();
}
