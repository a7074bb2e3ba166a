using System.Text;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Ply;
using FractalEngine.Parsing.Stl;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry;

/// <summary>Tests what messages about PLY and STL files show of the word at fault.</summary>
public sealed class MeshWordTests
{
    private const string Expected = "'format', 'element', 'property', 'comment' or 'end_header'";

    [Theory]
    [InlineData(39, 39)]
    [InlineData(40, 40)]
    [InlineData(41, 40)]
    [InlineData(5_000, 40)]
    public void Ply_WithALongWord_ShowsItsBeginning(int length, int shown) => Assert.StartsWith(
        $"test.ply:2:1: error: unexpected '{new string('a', shown)}', expected {Expected}\n",
        PlyFault($"ply\n{new string('a', length)}\n"), StringComparison.Ordinal);

    [Theory]
    [InlineData("\u0001b", "character U+0001")]
    [InlineData("a\u0001b", "'a?b'")]
    [InlineData("ä", "'ä'")]
    public void Ply_WithUnusualCharacters_NamesThem(string word, string shown) => Assert.StartsWith(
        $"test.ply:2:1: error: unexpected {shown}, expected {Expected}\n", PlyFault($"ply\n{word}\n"), StringComparison.Ordinal);

    [Theory]
    [InlineData("solid\nfacets", "test.stl:2:1: error: unexpected 'facets', expected 'facet' or 'endsolid'\n")]
    [InlineData("solid\nfacet normal 0 0 up", "test.stl:2:18: error: unexpected 'up', expected a number\n")]
    [InlineData("solid\nfacet outer ring", "test.stl:2:13: error: unexpected 'ring', expected 'loop'\n")]
    [InlineData("solid\nfacet outer loop vertex 0 nan 0", "test.stl:2:27: error: a coordinate is not finite\n")]
    [InlineData("solid\nfacet outer loop vertex 0 1e999 0",
        "test.stl:2:27: error: the number 1e999 is beyond the range of a double\n")]
    public void Stl_WithAFault_PointsAtIt(string text, string message) => Assert.StartsWith(
        message, Errors.MessageOf(() => StlReader.Read(new MeshBytes("test.stl", Encoding.UTF8.GetBytes(text)))),
        StringComparison.Ordinal);

    private static string PlyFault(string text) =>
        Errors.MessageOf(() => PlyReader.Read(new MeshBytes("test.ply", Encoding.UTF8.GetBytes(text))));
}
