using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Widgets;
using FractalEngine.Render.Ui;
using static System.FormattableString;

namespace FractalEngine.App.Window.Panels;

/// <summary>The panel of what the last frame cost, and what each optimisation has saved.</summary>
internal sealed class StatisticsPanel(WindowActions actions)
{
    public void Build(UserInterface ui)
    {
        var times = actions.Overlay.FrameTimes;
        ui.Graph(times, maximum: 1000 / 30.0);
        ui.Tooltip("time of the last frames; the full height is 1/30 s");
        ui.Row(1);
        ui.Label(times.Count == 0 ? "no frame yet" : Invariant($"last frames, at most {times.Max():F1} ms"), isDim: true);
        foreach (var (title, rows) in actions.Overlay.ReportTables)
        {
            ui.Heading(title);
            foreach (var (name, value) in rows)
            {
                ui.Fact(name, value);
            }
        }

        ui.Heading("Program");
        ui.Fact("memory", Invariant($"{GC.GetTotalMemory(false) / 1e6:F0} MB of objects"));
        if (actions.Document?.Physics.QueriesPerSecond is { } queries)
        {
            ui.Fact("queries", Invariant($"{queries:N0} face tests a second"));
        }
    }
}
