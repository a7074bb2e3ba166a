namespace FractalEngine.Parsing.Ply;

/// <summary>Types of numbers in PLY files.</summary>
internal enum PlyType
{
    /// <summary>A signed integer of one byte: <c>char</c>, <c>int8</c>.</summary>
    Int8,

    /// <summary>An unsigned integer of one byte: <c>uchar</c>, <c>uint8</c>.</summary>
    UInt8,

    /// <summary>A signed integer of two bytes: <c>short</c>, <c>int16</c>.</summary>
    Int16,

    /// <summary>An unsigned integer of two bytes: <c>ushort</c>, <c>uint16</c>.</summary>
    UInt16,

    /// <summary>A signed integer of four bytes: <c>int</c>, <c>int32</c>.</summary>
    Int32,

    /// <summary>An unsigned integer of four bytes: <c>uint</c>, <c>uint32</c>.</summary>
    UInt32,

    /// <summary>A floating-point number of four bytes: <c>float</c>, <c>float32</c>.</summary>
    Float,

    /// <summary>A floating-point number of eight bytes: <c>double</c>, <c>float64</c>.</summary>
    Double,
}
