using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>A recursive and its base, as they are declared: <c>z&lt;x&gt;</c>.</summary>
/// <param name="Name">Name of the recursive.</param>
/// <param name="BaseName">Name of its base.</param>
/// <param name="Start">Position of the name.</param>
/// <param name="BaseStart">Position of the name of the base.</param>
internal readonly record struct RecursiveHead(string Name, string BaseName, Cursor Start, Cursor BaseStart);
