namespace FractalEngine.Parsing.Wavefront;

/// <summary>What the bytes of a block can be.</summary>
internal enum ObjTextKind
{
    /// <summary>UTF-8, of which ASCII is a part.</summary>
    Utf8,

    /// <summary>Text that is not UTF-8: Latin-1, which old exporters wrote.</summary>
    Latin1,

    /// <summary>No text: there is a NUL byte.</summary>
    Binary,
}
