namespace FractalEngine.Parsing.Wavefront;

/// <summary>Place of a block of whole lines in a file.</summary>
/// <param name="Index">Number of blocks before it.</param>
/// <param name="Position">Position of its first byte in the file.</param>
/// <param name="Length">Length in bytes.</param>
internal readonly record struct ObjBlockBytes(int Index, long Position, int Length)
{
    /// <summary>Position of the first byte behind the block.</summary>
    public long End => Position + Length;
}
