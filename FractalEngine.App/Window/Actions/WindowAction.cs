using System.Collections.Immutable;
using FractalEngine.App.Window.State;
using FractalEngine.Render.Cameras;

namespace FractalEngine.App.Window.Actions;

/// <summary>Something that the user can do in the window: a row of the <see cref="ActionTable"/>.</summary>
/// <param name="Id">Name in the settings file, in lower case with hyphens.</param>
/// <param name="Menu">The menu that it stands in.</param>
/// <param name="Name">Short name, as menus show it.</param>
/// <param name="Help">One sentence without a full stop, for the manual, the list of keys and tooltips.</param>
internal sealed record WindowAction(string Id, string Menu, string Name, string Help)
{
    /// <summary>The keys unless the settings change them; none for mouse gestures and for actions of the menu alone.</summary>
    public ImmutableArray<KeyChord> Keys { get; init; } = [];

    /// <summary>What the mouse does, where no key does it.</summary>
    public string? Gesture { get; init; }

    /// <summary>The option of the command <c>view</c> that has the same effect; null for none.</summary>
    public string? Flag { get; init; }

    /// <summary>Runs a command of the window; null for one of the camera, and for keys that are held.</summary>
    public Func<WindowActions, Redraw>? Run { get; init; }

    /// <summary>Moves the camera, with the aspect ratio of the frame; null for other actions.</summary>
    public Action<FlyingCamera, double>? MoveCamera { get; init; }

    /// <summary>Tells whether what the action switches is on; null for actions that are no switches.</summary>
    public Func<WindowActions, bool>? IsOn { get; init; }

    public Func<WindowActions, bool> IsAvailable { get; init; } = static _ => true;

    /// <summary>True where the action can be chosen in a menu: it is no movement that goes on while a key is held.</summary>
    public bool IsCommand => Run is not null || MoveCamera is not null;

    /// <summary>What the action does, without the marks of code that the manual has.</summary>
    public string PlainHelp => Help.Replace("`", "", StringComparison.Ordinal);

    public string KeyText => Gesture ?? string.Join(", ", Keys);
}
