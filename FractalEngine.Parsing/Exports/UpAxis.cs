namespace FractalEngine.Parsing.Exports;

/// <summary>The axis that points up in a file.</summary>
public enum UpAxis
{
    /// <summary>The y axis, as in scenes.</summary>
    Y,

    /// <summary>The z axis, as programs for printing and drafting expect.</summary>
    Z,
}
