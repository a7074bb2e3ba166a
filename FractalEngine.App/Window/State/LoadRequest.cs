using FractalEngine.Parsing.Editing;

namespace FractalEngine.App.Window.State;

/// <summary>A file that is to be loaded, for which reason.</summary>
/// <param name="Path">Path of the mesh, fractal or scene, as it was opened.</param>
/// <param name="Continues">True for the document that is shown, under any name: its camera, bodies and edits go on.</param>
/// <param name="EditsBefore">The edits of the document when the file was asked for.</param>
internal sealed record LoadRequest(string Path, bool Continues, FileEdits EditsBefore)
{
    /// <summary>The edits that are loaded in the place of the files on the disk.</summary>
    public FileEdits Edits { get; init; } = FileEdits.None;

    /// <summary>Number of saves when the load began. What it reads may be older than a later one.</summary>
    public int SaveCount { get; init; }

    /// <summary>
    /// The load that has failed, where this one tries the scene without its last edit, to learn whether that is at fault; null for others.
    /// </summary>
    public LoadFault? Refused { get; init; }
}

/// <summary>Why the document can't be loaded again.</summary>
/// <param name="Request">The load that has failed.</param>
/// <param name="Error">Lines for the user.</param>
/// <param name="ShownFrom">When it is shown, unless another load ends before.</param>
internal sealed record LoadFault(LoadRequest Request, string Error, TimeSpan ShownFrom);
