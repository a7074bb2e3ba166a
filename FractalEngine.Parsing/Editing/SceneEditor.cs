using System.Collections.Immutable;
using FractalEngine.Core.Scenes;
using FractalEngine.Core.Scenes.Films;
using FractalEngine.Parsing.Sdo;

namespace FractalEngine.Parsing.Editing;

/// <summary>Changes the text of a scene as panels ask for. Lines that are not concerned stay as they are.</summary>
public static class SceneEditor
{
    // Begins a comment, which no other program needs to know.
    private const string HiddenMark = "#hidden ";

    // Of a film that begins with a key, seconds.
    private const double DefaultFilmDuration = 10;

    /// <summary>Parses the text of a scene.</summary>
    public static Scene Parse(string text) => SceneParser.Parse(new("scene", text)).Scene;

    /// <summary>Changes the scene that a text declares. Objects and lights keep their numbers, or are added at the end.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="change">Returns the changed scene.</param>
    /// <exception cref="ArgumentException">The name of an object, or that of its file, can't be written in a scene.</exception>
    public static string Change(string text, Func<Scene, Scene> change)
    {
        var parsed = SceneParser.Parse(new("scene", text));
        var changed = change(parsed.Scene);
        foreach (var declared in changed.Objects)
        {
            RequireWritable(declared.Name);
            RequireWritable(declared.File);
        }

        return SceneWriter.Write(changed, parsed);
    }

    /// <summary>Throws for a name that a scene can't hold.</summary>
    /// <exception cref="ArgumentException">It has a quote or a line break.</exception>
    public static void RequireWritable(string? name)
    {
        if (name?.IndexOfAny(['"', '\n', '\r']) >= 0)
        {
            throw new ArgumentException($"a name in a scene can't have a quote or a line break: {name}");
        }
    }

    /// <summary>Adds a camera to the film of a scene, in the place of one at the same time. Without a film, it gets one.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="key">The key, within the film.</param>
    public static string AddKey(string text, CameraKey key)
    {
        ArgumentNullException.ThrowIfNull(key);
        var parsed = SceneParser.Parse(new("scene", text));
        var film = parsed.Scene.Film ?? new(DefaultFilmDuration);
        // The first camera that is not earlier.
        var place = film.Keys.Index().FirstOrDefault(pair => pair.Item is CameraKey && pair.Item.Time >= key.Time);
        if (place.Item is not { } next)
        {
            return SceneWriter.Write(parsed.Scene with { Film = film with { Keys = film.Keys.Add(key) } }, parsed);
        }

        var line = SceneFormatter.Format(key) + parsed.Source.LineBreak;
        return string.Concat(parsed.Lines.Select(old => old.Kind != SceneDeclarationKind.FilmKey || old.Index != place.Index ? old.Text
            : next.Time > key.Time ? line + old.Text : line));
    }

    /// <summary>Removes the line of an object.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="objectIndex">Index of the object in the scene, from 0.</param>
    public static string RemoveObject(string text, int objectIndex) => RemoveLine(text, SceneDeclarationKind.SceneObject, objectIndex);

    /// <summary>Removes the line of a light.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="lightIndex">Index of the light in the scene, from 0.</param>
    public static string RemoveLight(string text, int lightIndex) => RemoveLine(text, SceneDeclarationKind.Light, lightIndex);

    /// <summary>Makes the line of an object a comment, so that the object is not shown.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="objectIndex">Index of the object in the scene, from 0.</param>
    public static string HideObject(string text, int objectIndex) => string.Concat(SceneParser.Parse(new("scene", text)).Lines.Select(
        line => line.Kind == SceneDeclarationKind.SceneObject && line.Index == objectIndex ? HiddenMark + line.Text : line.Text));

    /// <summary>Lists the objects that are hidden, as their lines declare them.</summary>
    public static ImmutableArray<string> FindHidden(string text) =>
    [
        .. text.Split('\n').Where(static line => line.StartsWith(HiddenMark, StringComparison.Ordinal))
            .Select(static line => line[HiddenMark.Length..].TrimEnd('\r')),
    ];

    /// <summary>Shows a hidden object again.</summary>
    /// <param name="text">Text of the scene.</param>
    /// <param name="line">The object's line, as <see cref="FindHidden"/> has it.</param>
    public static string ShowObject(string text, string line)
    {
        var lines = text.Split('\n');
        var place = Array.FindIndex(lines, hidden => hidden.TrimEnd('\r') == HiddenMark + line);
        if (place >= 0)
        {
            lines[place] = lines[place][HiddenMark.Length..];
        }

        return string.Join('\n', lines);
    }

    private static string RemoveLine(string text, SceneDeclarationKind kind, int index)
    {
        var lines = SceneParser.Parse(new("scene", text)).Lines;
        return string.Concat(lines.Where(line => line.Kind != kind || line.Index != index).Select(static line => line.Text));
    }
}
