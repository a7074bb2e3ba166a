using System.Collections.Immutable;
using System.Globalization;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Tools;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Core;
using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;
using FractalEngine.Render.Ui;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of a fractal: its depth and all components of its vectors as sliders, which change the text of its file.</summary>
internal sealed class FractalPanel(WindowActions actions)
{
    private const string Axes = "xyz";

    private readonly FractalFacts _facts = new();

    // The file that was chosen of several, and the one whose numbers are shown.
    private string? _chosen;
    private string? _path;
    private string _text = "";
    private FileStamp? _stamp;
    private string? _problem;
    private ImmutableArray<FractalNumber> _numbers = [];

    // What the file says about each of them.
    private ImmutableArray<string?> _comments = [];

    // The vectors that place the selected instance, and the selection that the panel was scrolled to.
    private ImmutableHashSet<string> _marked = [];
    private (ImmutableArray<int> Path, int Depth) _scrolled;
    private bool _isScrolling;

    public void Build(UserInterface ui)
    {
        var models = actions.Document?.File.Scene.Models.OfType<FractalModel>()
            .Where(static model => model.SourcePath is { } path && path.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase)).ToArray();
        if (models is not [var first, ..])
        {
            ui.Paragraph("There is no fractal file (.fdo) in this scene.");
            return;
        }

        var selected = actions.Document!.Tool.Selected?.Object.Model.SourcePath;
        var model = models.FirstOrDefault(model => model.SourcePath == selected)
            ?? models.FirstOrDefault(model => model.SourcePath == _chosen) ?? first;
        if (models.Length > 1)
        {
            foreach (var other in models)
            {
                if (ui.Selectable(other.Name, other == model))
                {
                    _chosen = other.SourcePath;
                    actions.Document.Tool.Selected = null;
                    actions.RequestDraw();
                }
            }
        }

        _facts.Build(ui, model);
        if (TryRead(model.SourcePath!))
        {
            MarkSelected(model);
            // Sliders of another file have ranges of their own.
            ui.Scope(_path!, () => BuildNumbers(ui));
            _isScrolling = false;
        }
        else if (_problem is { } problem)
        {
            ui.Row(1);
            ui.Paragraph(problem, isWarning: true);
        }
    }

    /// <summary>Reads the numbers of a file, unless that is done already.</summary>
    private bool TryRead(string path)
    {
        try
        {
            var edits = actions.Document!.Edits;
            // A panel is built at each movement over it, and the file is read when it has changed.
            FileStamp? stamp = edits.Files.ContainsKey(path) ? null : FileStamp.Of(path);
            if (path == _path && stamp is not null && stamp == _stamp)
            {
                return _problem is null;
            }

            _stamp = stamp;
            var text = edits.TextOf(path);
            if (path != _path || text != _text || _problem is not null)
            {
                _numbers = FindNumbers(path, text);
                _comments = FractalComments.Above(text, _numbers.Select(static number => number.Offset));
            }

            (_path, _text, _problem) = (path, text, null);
        }
        catch (FractalEngineException exception)
        {
            _path = path;
            _problem = exception.Message;
        }

        return _problem is null;
    }

    private static ImmutableArray<FractalNumber> FindNumbers(string path, string text) =>
        FractalNumber.FindAll(new SourceText(Path.GetFileName(path), text));

    private void BuildNumbers(UserInterface ui)
    {
        // First, since it changes most.
        ui.Row(1);
        for (var i = 0; i < _numbers.Length; i++)
        {
            if (_numbers[i].Role == FractalNumberRole.Depth)
            {
                BuildSlider(ui, i, $"depth of {_numbers[i].Name}", 0, Math.Max(8, _numbers[i].Value + 2), 1);
                Explain(ui, i);
            }
        }

        string? name = null;
        var vectorCount = _numbers.Max(static number => number.Vector) ?? 0;
        for (var i = 0; i < _numbers.Length; i++)
        {
            var number = _numbers[i];
            if (number.Role == FractalNumberRole.Argument)
            {
                BuildArgument(ui, i, vectorCount, isFirst: name != number.Name);
                name = number.Name;
                continue;
            }

            if (number.Role == FractalNumberRole.Depth)
            {
                continue;
            }

            if (number.Role == FractalNumberRole.Named)
            {
                var ends = number.Range ?? (RangeOf(number).Minimum, RangeOf(number).Maximum);
                ui.Row(1);
                BuildSlider(ui, i, number.Name, ends.From, ends.To, 0);
                Explain(ui, i);
                continue;
            }

            var title = $"{number.Role} {number.Name}";
            if (name != title)
            {
                name = title;
                BuildTitle(ui, i);
                ui.Row(1, 1, 1);
            }

            var (minimum, maximum, step) = RangeOf(_numbers[i]);
            BuildSlider(ui, i, number.IsEven ? Axes : Axes[number.Component].ToString(), minimum, maximum, step);
            Explain(ui, i);
        }
    }

    private void Explain(UserInterface ui, int index)
    {
        if (_comments[index] is { } comment)
        {
            ui.Tooltip(About(index) ?? comment);
        }
    }

    /// <summary>Returns what the file says about one vector; null where it says nothing, or the same about all.</summary>
    private string? About(int index) => _comments[index] is { } comment && _numbers[index].Vector is { } vector
        ? FractalComments.About(comment, vector) : null;

    /// <summary>Adds what a vector means, marked where it places the selected instance.</summary>
    private void BuildTitle(UserInterface ui, int index)
    {
        var number = _numbers[index];
        var vector = number.Vector?.ToString(CultureInfo.InvariantCulture) ?? number.Name;
        var meaning = $"{number.Role.ToString().ToLowerInvariant()} {vector}";
        // Of several vectors that the file explains together, the first one has the words.
        var title = About(index) is { } about && (index < 3 || About(index - 3) != about) ? $"{vector}: {about}" : meaning;
        if (_marked.Contains(number.Name))
        {
            if (_isScrolling)
            {
                _isScrolling = false;
                ui.ScrollHere(2);
            }

            ui.Heading($"▶ {title}");
        }
        else
        {
            ui.Row(1);
            ui.Paragraph(title, isDim: true);
        }

        if (_comments[index] is { } comment)
        {
            ui.Tooltip($"{meaning}: {About(index) ?? comment}");
        }
    }

    /// <summary>Marks the vectors of the call that places the selected instance, where the file tells which call that is.</summary>
    private void MarkSelected(FractalModel model)
    {
        _marked = [];
        if (actions.Document!.Tool.Selected is not { Depth: > 0 and var depth, Path: var path } selected
            || !ReferenceEquals(selected.Object.Model, model))
        {
            _scrolled = default;
            return;
        }

        // An identity places nothing: the call of a level above does.
        var sizes = FractalSelection.SetSizes(model.Fractal, path[..depth]);
        for (var level = sizes.Length; level > 0 && _marked.IsEmpty; level--)
        {
            var size = sizes[level - 1];
            var calls = _numbers.Where(number => number.Call?.SetSize == size).ToArray();
            _marked = calls.Select(static number => number.Call!.Value.Set).Distinct().Count() != 1 ? []
                : [.. calls.Where(number => number.Call!.Value.Index == path[level - 1])
                    .Select(static number => string.Create(CultureInfo.InvariantCulture, $"v{number.Value}"))];
        }

        if (_scrolled != (path, depth))
        {
            _scrolled = (path, depth);
            _isScrolling = true;
        }
    }

    private void BuildArgument(UserInterface ui, int index, int vectorCount, bool isFirst)
    {
        var number = _numbers[index];
        if (isFirst)
        {
            ui.Row(1);
            ui.Label($"vectors of call {CallText(number.Name)}", isDim: true);
            ui.Row(1, 1, 1);
        }

        BuildSlider(ui, index, "v", 1, vectorCount, 1);
        ui.Tooltip("number of the vector that the function takes here");
    }

    /// <summary>Turns "t 3" into "3, of function t".</summary>
    private static string CallText(string name) => name.Split(' ') is [var function, var call] ? $"{call}, of function {function}" : name;

    private void BuildSlider(
        UserInterface ui, int index, string label, double minimum, double maximum, double step) => ui.Scope(index, () =>
    {
        var isBounded = _numbers[index].Role == FractalNumberRole.Argument;
        if (ui.Slider(label, _numbers[index].Value, minimum, maximum, step, isBounded) is not { } value)
        {
            return;
        }

        var text = _numbers[index].Replace(_text, value);
        if (text != _text)
        {
            Edit(text, ui.Interaction);
        }
    });

    /// <summary>Changes the text, unless it would be no fractal any more: then no number of it could be turned back.</summary>
    private void Edit(string text, int? interaction)
    {
        try
        {
            FindNumbers(_path!, text);
            actions.Saver.Edit(_path!, text, interaction);
            // The places of all numbers behind it have moved.
            TryRead(_path!);
        }
        catch (FractalEngineException exception)
        {
            actions.Show(exception.Message);
        }
    }

    private static (double Minimum, double Maximum, double Step) RangeOf(FractalNumber number)
    {
        var reach = Math.Max(1, Math.Abs(number.Value));
        return number.Role switch
        {
            FractalNumberRole.Rotation => (number.Value - 90, number.Value + 90, 0.5),
            // A factor of 0 would be an error.
            FractalNumberRole.Scale when number.Value > 0 => (0.01, Math.Max(1, 2 * number.Value), 0.01),
            _ => (number.Value - reach, number.Value + reach, 0),
        };
    }
}
