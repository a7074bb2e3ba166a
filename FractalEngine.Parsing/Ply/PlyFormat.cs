namespace FractalEngine.Parsing.Ply;

/// <summary>How the numbers of a PLY file are written.</summary>
internal enum PlyFormat
{
    /// <summary>Numbers are written as text.</summary>
    Text,

    /// <summary>Numbers are bytes, the least significant one first.</summary>
    LittleEndian,

    /// <summary>Numbers are bytes, the most significant one first.</summary>
    BigEndian,
}
