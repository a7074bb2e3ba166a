using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Scenes;

namespace FractalEngine.Parsing.Exports;

/// <summary>A format in which scenes leave: one class a format, each in a room of its own.</summary>
public abstract class SceneExport
{
    /// <summary>The ending of its files, with the dot.</summary>
    public abstract string Ending { get; }

    /// <summary>Whether a mesh or fractal that is opened alone is loaded with sky, sun and colours, as for images.</summary>
    public virtual bool IsStaged => false;

    /// <summary>Writes a scene as a file of the format.</summary>
    /// <param name="scene">Scene whose objects have their models.</param>
    /// <param name="settings">Limits, and how much of the levels is kept.</param>
    /// <param name="stream">Receives the file from its beginning to its end; it is not read, and need not be able to seek.</param>
    /// <exception cref="FractalLimitException">The scene exceeds a limit. Nothing is written then.</exception>
    public ExportSummary Write(LoadedScene scene, ExportSettings settings, Stream stream)
    {
        ArgumentNullException.ThrowIfNull(scene);
        ArgumentNullException.ThrowIfNull(settings);
        ArgumentNullException.ThrowIfNull(stream);
        return WriteCore(scene, settings, stream);
    }

    /// <summary>Writes a scene, see <see cref="Write"/>.</summary>
    protected abstract ExportSummary WriteCore(LoadedScene scene, ExportSettings settings, Stream stream);
}
