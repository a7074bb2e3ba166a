using System.Text;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Wavefront;
using Xunit.Sdk;

namespace FractalEngine.Tests.Support;

/// <summary>
/// All that parsing an OBJ file gives: the mesh, or the error; and every message and position. The grammar and the reader must agree on it.
/// </summary>
internal sealed record ObjOutcome(Mesh? Mesh, string Messages)
{
    /// <summary>Small blocks have many borders.</summary>
    public const int SmallBlock = 3000;

    public static ObjOutcome OfGrammar(byte[] bytes) =>
        Of(() => ObjParser.Parse(SourceText.Decode(bytes, "test.obj", acceptLatin1: true)));

    public static ObjOutcome OfReader(byte[] bytes, int blockSize = ObjReader.DefaultBlockSize, int threadCount = 1) =>
        Of(() => ObjReader.Read(new MemoryStream(bytes), "test.obj", null, blockSize, threadCount));

    /// <summary>Fails unless the grammar alone and the reader, with small blocks and with usual ones, have the same outcome.</summary>
    /// <returns>Whether the outcome is a mesh.</returns>
    public static bool AssertSame(byte[] bytes)
    {
        var expected = OfGrammar(bytes);
        AssertEqual(expected, OfReader(bytes, SmallBlock), bytes, "small blocks");
        AssertEqual(expected, OfReader(bytes, SmallBlock, threadCount: 2), bytes, "small blocks on two threads");
        AssertEqual(expected, OfReader(bytes), bytes, "usual blocks");
        return expected.Mesh is not null;
    }

    /// <summary>Parses a text by the grammar, after checking that the reader agrees.</summary>
    public static ParsedObj ParseChecked(string text)
    {
        // Lone halves of surrogates can't be written. NUL is found before the grammar would see it.
        if (!text.Contains('\0', StringComparison.Ordinal) && Encoding.UTF8.GetString(Encoding.UTF8.GetBytes(text)) == text)
        {
            AssertSame(Encoding.UTF8.GetBytes(text));
        }

        return ObjParser.Parse(new("test.obj", text));
    }

    private static ObjOutcome Of(Func<ParsedObj> parse)
    {
        try
        {
            var parsed = parse();
            var positions = parsed.MaterialLibraryPositions
                .Concat(parsed.MaterialPositions.OrderBy(pair => pair.Key, StringComparer.Ordinal).Select(pair => pair.Value));
            var messages = parsed.Warnings.Concat(positions.Select(position => position.Diagnose("here")));
            return new(parsed.Mesh, $"{parsed.ByteCount} {parsed.Mesh.Bounds} {string.Join('\n', messages)}");
        }
        catch (SourceException error)
        {
            return new(null, $"{error.Diagnostic} {error.Diagnostic.IsLimitExceeded} {error.Diagnostic.SourceLine}");
        }
    }

    private static void AssertEqual(ObjOutcome expected, ObjOutcome actual, byte[] bytes, string how)
    {
        if (expected != actual)
        {
            var text = bytes.Length > 4000 ? $"{bytes.Length} bytes" : Encoding.Latin1.GetString(bytes);
            throw new XunitException($"with {how} the outcome is\n{actual.Messages}\nnot\n{expected.Messages}\nfor\n{text}");
        }
    }
}
