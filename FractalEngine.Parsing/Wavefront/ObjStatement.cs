namespace FractalEngine.Parsing.Wavefront;

/// <summary>A line of a block with a name or an unknown keyword, which the grammar reads once all lines before it are known.</summary>
/// <param name="Start">Offset of the line in the block, in bytes.</param>
/// <param name="Length">Length of the line with its break, in bytes.</param>
/// <param name="Line">Number of lines of the block before it.</param>
/// <param name="FaceCount">Number of triangles of the block before it.</param>
internal sealed record ObjStatement(int Start, int Length, int Line, int FaceCount);
