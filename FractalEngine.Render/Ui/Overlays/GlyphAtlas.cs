using System.IO.Compression;
using FractalEngine.Render.Gl;

namespace FractalEngine.Render.Ui.Overlays;

/// <summary>The glyphs of a monospaced font, baked at several sizes. The file format is described in eng/bake-glyphs.py.</summary>
/// <param name="characters">Sorted; the index of a character is that of its glyph.</param>
/// <param name="sheets">Sheets of all glyphs at each size, the smallest first.</param>
internal sealed class GlyphAtlas(char[] characters, GlyphSheet[] sheets)
{
    private static readonly Lazy<GlyphAtlas> LazyShared = new(Load);

    /// <summary>The embedded atlas, read once.</summary>
    /// <exception cref="InvalidDataException">The file is not such an atlas.</exception>
    public static GlyphAtlas Shared => LazyShared.Value;

    /// <summary>Sheets of all glyphs at each size, the smallest first.</summary>
    public IReadOnlyList<GlyphSheet> Sheets { get; } = sheets;

    /// <summary>Reads the atlas that is embedded in the assembly.</summary>
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
        char[] characters = [.. Enumerable.Range(0, reader.ReadUInt16()).Select(_ => (char)reader.ReadUInt16())];
        var sheets = new GlyphSheet[reader.ReadUInt16()];
        for (var i = 0; i < sheets.Length; i++)
        {
            var width = reader.ReadUInt16();
            var height = reader.ReadUInt16();
            var baseline = reader.ReadUInt16();
            sheets[i] = new(width, height, baseline, reader.ReadBytes(characters.Length * width * height));
        }

        return new(characters, sheets);
    }

    /// <summary>Returns the index of the sheet whose lines are closest to a height in pixels; the smaller one of two.</summary>
    public int ClosestSheet(double lineHeight) =>
        Enumerable.Range(0, Sheets.Count).MinBy(index => Math.Abs(Sheets[index].CellHeight - lineHeight));

    /// <summary>Returns the index of a character's glyph; that of the question mark for a character without one.</summary>
    public int GlyphOf(char character)
    {
        var index = Array.BinarySearch(characters, character);
        return index >= 0 ? index : Array.BinarySearch(characters, '?');
    }
}
