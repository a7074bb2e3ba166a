namespace FractalEngine.Parsing.Scenes;

/// <summary>A line of a scene file as it stands there, and what it declares.</summary>
/// <param name="Text">With its line break, if it has one.</param>
/// <param name="Kind">Null for comments and empty lines.</param>
/// <param name="Index">Which light or object of the scene it is, from 0; 0 for what a scene has only one of.</param>
/// <param name="FileNameOffset">Where the name of an object's file stands in the text.</param>
public sealed record SceneLine(string Text, SceneDeclarationKind? Kind, int Index, int FileNameOffset);
