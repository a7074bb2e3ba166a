using System.IO.Compression;
using FractalEngine.Render.Gl;

namespace FractalEngine.Render.Ui;

/// <summary>The glyphs of a monospaced font, baked at several sizes. The file's layout is told in eng/bake-glyphs.py.</summary>
internal sealed class GlyphAtlas
{
    private readonly char[] _characters;

    private GlyphAtlas(char[] characters, GlyphSheet[] sheets) => (_characters, Sheets) = (characters, sheets);

    /// <summary>One for each size, smallest first.</summary>
    public IReadOnlyList<GlyphSheet> Sheets { get; }

    /// <summary>Reads the atlas that is part of the assembly.</summary>
    /// <exception cref="InvalidDataException">The file is not such an atlas.</exception>
    public static GlyphAtlas Load()
    {
        using var file = EmbeddedResource.Open("Ui/mono.atlas");
        Span<byte> magic = stackalloc byte[4];
        file.ReadExactly(magic);
        if (!magic.SequenceEqual("FGA1"u8))
        {
            throw new InvalidDataException("Ui/mono.atlas is not a glyph atlas");
        }

        using var reader = new BinaryReader(new DeflateStream(file, CompressionMode.Decompress));
        var characters = new char[reader.ReadUInt16()];
        for (var i = 0; i < characters.Length; i++)
        {
            characters[i] = (char)reader.ReadUInt16();
        }

        var sheets = new GlyphSheet[reader.ReadUInt16()];
        for (var i = 0; i < sheets.Length; i++)
        {
            var (width, height, baseline) = (reader.ReadUInt16(), reader.ReadUInt16(), reader.ReadUInt16());
            sheets[i] = new(width, height, baseline, reader.ReadBytes(characters.Length * width * height));
        }

        return new(characters, sheets);
    }

    /// <summary>The number of a character's glyph; that of the question mark where the font here has none.</summary>
    public int GlyphOf(char character) => Array.BinarySearch(_characters, character) is >= 0 and var found
        ? found
        : Array.BinarySearch(_characters, '?');
}
