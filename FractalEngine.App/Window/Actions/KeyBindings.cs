using System.Collections.Immutable;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Actions;

/// <summary>Translates keys that the settings have changed to those of the <see cref="ActionTable"/>.</summary>
internal sealed class KeyBindings
{
    private readonly Dictionary<KeyChord, KeyChord?> _translations;

    // What a key meant when it was pressed is what it means when it is released.
    private readonly Dictionary<Key, Key> _heldKeys = [];

    /// <summary>Creates the bindings of a window.</summary>
    /// <param name="changed">The first key of actions that differ from the table, by their ids. Unknown ids are ignored.</param>
    public KeyBindings(ImmutableDictionary<string, KeyChord> changed)
    {
        Changed = changed;
        var moved = ActionTable.All.Where(action => changed.ContainsKey(action.Id) && !action.Keys.IsEmpty).ToArray();
        _translations = moved.ToDictionary(static action => action.Keys[0], static _ => (KeyChord?)null);
        foreach (var action in moved)
        {
            _translations[changed[action.Id]] = action.Keys[0];
        }
    }

    /// <summary>The first key of actions that differ from the table, by their ids.</summary>
    public ImmutableDictionary<string, KeyChord> Changed { get; }

    public string TextOf(WindowAction action) => Changed.TryGetValue(action.Id, out var chord)
        ? string.Join(", ", action.Keys.Skip(1).Prepend(chord))
        : action.KeyText;

    /// <summary>Translates a key to that of the table; other events stay as they are.</summary>
    public WindowEvent Translate(WindowEvent windowEvent)
    {
        if (_translations.Count == 0)
        {
            return windowEvent;
        }

        switch (windowEvent)
        {
            case KeyPressed pressed when _translations.TryGetValue(KeyChord.Of(pressed), out var chord):
                var translated = new KeyPressed(
                    chord?.Key ?? Key.Unknown,
                    chord is { Modifiers: not KeyModifiers.None } known ? known.Modifiers : pressed.Modifiers & ~KeyModifiers.Control,
                    pressed.IsRepeat);
                _heldKeys[pressed.Key] = translated.Key;
                return translated;
            case KeyReleased released when _heldKeys.Remove(released.Key, out var key):
                return released with { Key = key };
            default:
                return windowEvent;
        }
    }
}
