using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The list of all actions with their keys, which can be searched.</summary>
internal sealed class KeyList
{
    /// <summary>Names the dialog at its head, and in <see cref="UserInterface.OpenDialog"/>.</summary>
    public const string Title = "Keys";

    private readonly KeyBindings _bindings;
    private readonly Action<WindowAction> _choose;
    private readonly UiPanel _panel;
    private string _search = "";
    private bool _isFirst;

    /// <summary>Makes the list of a window.</summary>
    /// <param name="bindings">The keys as they are bound now.</param>
    /// <param name="choose">Runs an action that was clicked.</param>
    public KeyList(KeyBindings bindings, Action<WindowAction> choose)
    {
        _bindings = bindings;
        _choose = choose;
        _panel = new(Title, BuildRows);
    }

    /// <summary>Begins with an empty search.</summary>
    public void Clear()
    {
        _search = "";
        _isFirst = true;
        _panel.ScrolledRows = 0;
    }

    /// <summary>Adds the dialog while it is open.</summary>
    public void Build(UserInterface ui)
    {
        ui.Dialog(Title, () => ui.TextField("search", ref _search, takesKeyboard: _isFirst), _panel);
        _isFirst = false;
    }

    private void BuildRows(UserInterface ui)
    {
        var actions = ActionTable.All.Where(Matches).ToArray();
        ui.Row(18, 1);
        foreach (var action in actions)
        {
            var keys = _bindings.TextOf(action);
            var label = keys.Length > 0 ? keys : $"{action.Menu} menu";
            if (action.IsCommand)
            {
                if (ui.Button(label))
                {
                    ui.CloseDialog();
                    _choose(action);
                }
            }
            else
            {
                ui.Paragraph(label);
            }

            ui.Paragraph(action.PlainHelp);
        }

        if (actions.Length == 0)
        {
            ui.Paragraph("no action has these words");
        }
    }

    private bool Matches(WindowAction action)
    {
        var text = $"{action.Menu} {action.Name} {action.Help} {_bindings.TextOf(action)}";
        return Array.TrueForAll(_search.Split(' '), word => text.Contains(word, StringComparison.OrdinalIgnoreCase));
    }
}
