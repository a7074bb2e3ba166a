using FractalEngine.App.Window.Actions;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The list of all actions with their keys, which can be searched.</summary>
internal sealed class KeyList
{
    private readonly WindowActions _actions;
    private readonly UiPanel _panel;
    private string _search = "";

    public KeyList(WindowActions actions)
    {
        _actions = actions;
        _panel = new(PanelLayout.KeysTitle, BuildRows);
    }

    /// <summary>Adds the dialog while it is open. Each time it begins with an empty search.</summary>
    public void Build(UserInterface ui)
    {
        if (_actions.Panels.IsKeyListNew)
        {
            _search = "";
            _panel.ScrolledRows = 0;
        }

        ui.Dialog(PanelLayout.KeysTitle, () => ui.TextField("search", ref _search, takesKeyboard: _actions.Panels.IsKeyListNew), _panel);
        _actions.Panels.IsKeyListNew = false;
    }

    private void BuildRows(UserInterface ui)
    {
        var actions = ActionTable.All.Where(Matches).ToArray();
        ui.Row(18, 1);
        foreach (var action in actions)
        {
            var keys = _actions.Panels.Bindings.TextOf(action);
            var label = keys.Length > 0 ? keys : $"{action.Menu} menu";
            if (action.IsCommand)
            {
                if (ui.Button(label))
                {
                    ui.CloseDialog();
                    _actions.Choose(action);
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
        var text = $"{action.Menu} {action.Name} {action.Help} {_actions.Panels.Bindings.TextOf(action)}";
        return Array.TrueForAll(_search.Split(' '), word => text.Contains(word, StringComparison.OrdinalIgnoreCase));
    }
}
