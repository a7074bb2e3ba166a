using FractalEngine.Render.Ui.Overlays;

namespace FractalEngine.Render.Ui;

/// <summary>A panel of the user interface: its contents, and the state that the user changes.</summary>
/// <param name="title">Title, which also tells panels apart.</param>
/// <param name="build">Adds the widgets, each time the interface is built.</param>
public sealed class UiPanel(string title, Action<UserInterface> build)
{
    /// <summary>Title, which also tells panels apart.</summary>
    public string Title { get; } = title;

    /// <summary>Adds the widgets, each time the interface is built.</summary>
    public Action<UserInterface> Build { get; } = build;

    /// <summary>Whether the panel is shown.</summary>
    public bool IsOpen { get; set; }

    /// <summary>Whether only its title is shown.</summary>
    public bool IsFolded { get; set; }

    /// <summary>Column that the panel stands in; floating panels stand where the user has moved them.</summary>
    public UiDock Dock { get; set; }

    /// <summary>Left edge of a floating panel, pixels at scale 1.</summary>
    public double X { get; set; }

    /// <summary>Top edge of a floating panel, pixels at scale 1.</summary>
    public double Y { get; set; }

    /// <summary>Number of rows that are scrolled out above.</summary>
    public int ScrolledRows { get; set; }

    /// <summary>Place of the panel when the interface was built last; without size while it is closed.</summary>
    public UiRect Bounds { get; internal set; }

    /// <summary>Height of all contents when the panel was built last, pixels.</summary>
    internal int ContentHeight { get; set; }

    /// <summary>Larger for panels that were clicked later, which stand in front.</summary>
    internal int Order { get; set; }
}
