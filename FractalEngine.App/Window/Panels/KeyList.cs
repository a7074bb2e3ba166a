using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The list of all actions with their keys, which can be searched.</summary>
internal sealed class KeyList
{
    private readonly PanelLayout _layout;
    private readonly Action<WindowAction> _choose;
    private readonly UiPanel _panel;
    private string _search = "";

    /// <summary>Makes the list of a window.</summary>
    /// <param name="layout">Opens the list, and has the keys as they are bound now.</param>
    /// <param name="choose">Runs an action that was clicked.</param>
    public KeyList(PanelLayout layout, Action<WindowAction> choose)
    {
        _layout = layout;
        _choose = choose;
        _panel = new(PanelLayout.KeysTitle, BuildRows);
    }

    /// <summary>Adds the dialog while it is open. Each time it begins with an empty search.</summary>
    public void Build(UserInterface ui)
    {
        if (_layout.IsKeyListNew)
        {
            _search = "";
            _panel.ScrolledRows = 0;
        }

        ui.Dialog(PanelLayout.KeysTitle, () => ui.TextField("search", ref _search, takesKeyboard: _layout.IsKeyListNew), _panel);
        _layout.IsKeyListNew = false;
    }

    private void BuildRows(UserInterface ui)
    {
        var actions = ActionTable.All.Where(Matches).ToArray();
        ui.Row(18, 1);
        foreach (var action in actions)
        {
            var keys = _layout.Bindings.TextOf(action);
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
        var text = $"{action.Menu} {action.Name} {action.Help} {_layout.Bindings.TextOf(action)}";
        return Array.TrueForAll(_search.Split(' '), word => text.Contains(word, StringComparison.OrdinalIgnoreCase));
    }
}
