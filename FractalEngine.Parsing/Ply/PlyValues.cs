using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Ply;

/// <summary>Reads the numbers behind the header of a PLY file, one after the other.</summary>
internal abstract class PlyValues
{
    /// <summary>Number of bytes that no number has been read from.</summary>
    public abstract long RemainingBytes { get; }

    /// <summary>Reads the next number; it may be infinite or NaN.</summary>
    /// <exception cref="SourceException">The file ends before it, or has something else.</exception>
    public abstract double Read(PlyType type);

    /// <summary>Smallest number of bytes that a number takes.</summary>
    public abstract int MinSize(PlyType type);

    /// <summary>Creates the error of the number read last.</summary>
    public abstract SourceException Error(string message, bool isLimitExceeded = false);

    /// <summary>Creates the reader of a format.</summary>
    /// <param name="bytes">The file.</param>
    /// <param name="header">Its header, behind which the numbers begin.</param>
    public static PlyValues Create(MeshBytes bytes, PlyHeader header) => header.Format == PlyFormat.Text
        ? new PlyTextValues(bytes, header.Length)
        : new PlyBinaryValues(bytes, header.Length, header.Format == PlyFormat.BigEndian);
}
