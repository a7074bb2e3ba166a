namespace FractalEngine.Parsing.Meshes;

/// <summary>How the numbers of a PLY file are written.</summary>
internal enum PlyFormat
{
    /// <summary>As text.</summary>
    Text,

    /// <summary>As bytes, the least significant one first.</summary>
    LittleEndian,

    /// <summary>As bytes, the most significant one first.</summary>
    BigEndian,
}
