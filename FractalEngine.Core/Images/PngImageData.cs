using System.IO.Compression;

namespace FractalEngine.Core.Images;

/// <summary>Decodes the compressed pixels of an image: <c>IDAT</c> chunks, zlib, filters, passes (PNG, third edition, §7 to §10).</summary>
internal sealed class PngImageData
{
    // As much as stays in the second cache, beside the rows that are written.
    private const int BlockBytes = 1 << 16;

    private readonly PngHeader _header;
    private readonly PngChunkReader _chunks;
    private readonly PngRowConverter _converter;
    private readonly byte[] _pixels;

    // RGBA is restored where it belongs. Everything else is restored in one of two rows, and converted, and put in its place.
    private readonly bool _isInPlace;
    private readonly byte[] _block;
    private readonly byte[] _converted;
    private byte[] _restored;
    private byte[] _above;

    private PngImageData(PngHeader header, PngColours colours, PngChunkReader chunks)
    {
        _header = header;
        _chunks = chunks;
        _converter = new(header, colours);
        _isInPlace = header is { ColourType: PngColourType.Rgba, BitDepth: 8, IsInterlaced: false };
        var rowBytes = header.RowBytes(header.Width);
        _block = new byte[LineBytes(rowBytes) * Math.Clamp(BlockBytes / LineBytes(rowBytes), 1, header.Height)];
        _converted = new byte[header.IsInterlaced ? 4 * header.Width : 0];
        _restored = new byte[_isInPlace ? 0 : rowBytes];
        _above = new byte[rowBytes];
        // Every byte is written before anyone sees it.
        _pixels = GC.AllocateUninitializedArray<byte>(checked(4 * header.Width * header.Height));
    }

    /// <summary>Decodes all pixels of the image.</summary>
    /// <param name="header">Of the image, whose pixels fit into an array.</param>
    /// <param name="colours">Its palette and transparency.</param>
    /// <param name="chunks">At the first <c>IDAT</c>; afterwards at the first chunk behind the last of them.</param>
    /// <returns>RGBA, the top row first. [height × width × 4]</returns>
    /// <exception cref="PngException">The data is damaged or too short.</exception>
    public static byte[] Decode(PngHeader header, PngColours colours, PngChunkReader chunks)
    {
        var image = new PngImageData(header, colours, chunks);
        using var data = new PngDataStream(chunks);
        data.CheckFormat();
        using var decompressed = new ZLibStream(data, CompressionMode.Decompress, leaveOpen: true);
        foreach (var pass in PngPass.Of(header))
        {
            image.DecodePass(pass, decompressed);
        }

        // Nothing more is expected, but only at its end does the stream compare its checksum. Whatever there is more is not decompressed.
        Span<byte> more = stackalloc byte[1];
        image.Decompress(decompressed, more);
        data.SkipRest();
        return image._pixels;
    }

    /// <summary>Each row has a byte before it, which names its filter.</summary>
    private static int LineBytes(int rowBytes) => 1 + rowBytes;

    private void DecodePass(PngPass pass, ZLibStream decompressed)
    {
        var columns = pass.Columns(_header.Width);
        var rows = pass.Rows(_header.Height);
        if (columns == 0 || rows == 0)
        {
            return;
        }

        _above.AsSpan().Clear();
        var lineBytes = LineBytes(_header.RowBytes(columns));
        var linesOfBlock = _block.Length / lineBytes;
        for (var row = 0; row < rows; row += linesOfBlock)
        {
            var lines = _block.AsSpan(0, Math.Min(linesOfBlock, rows - row) * lineBytes);
            if (Decompress(decompressed, lines) < lines.Length)
            {
                throw Error($"the compressed pixels end early: the image has {_header.Width}×{_header.Height}");
            }

            for (var i = 0; i * lineBytes < lines.Length; i++)
            {
                DecodeRow(lines.Slice(i * lineBytes, lineBytes), pass, columns, pass.Top + ((row + i) * pass.StepY));
            }
        }
    }

    private void DecodeRow(ReadOnlySpan<byte> line, PngPass pass, int columns, int y)
    {
        if (_isInPlace)
        {
            Restore(line, y == 0 ? _above : Row(y - 1), Row(y));
            return;
        }

        var restored = _restored.AsSpan(0, line.Length - 1);
        Restore(line, _above.AsSpan(0, restored.Length), restored);
        if (_header.IsInterlaced)
        {
            var converted = _converted.AsSpan(0, 4 * columns);
            Convert(restored, converted);
            Scatter(converted, pass, y);
        }
        else
        {
            Convert(restored, Row(y));
        }

        (_above, _restored) = (_restored, _above);
    }

    private Span<byte> Row(int y) => _pixels.AsSpan(4 * _header.Width * y, 4 * _header.Width);

    /// <summary>Fills a buffer as far as there is data.</summary>
    private int Decompress(ZLibStream decompressed, Span<byte> buffer)
    {
        try
        {
            return decompressed.ReadAtLeast(buffer, buffer.Length, throwOnEndOfStream: false);
        }
        catch (InvalidDataException exception)
        {
            throw Error("the compressed pixels are damaged", exception);
        }
    }

    private void Restore(ReadOnlySpan<byte> line, ReadOnlySpan<byte> above, Span<byte> target)
    {
        if (!PngUnfilter.TryRestore(line[0], line[1..], above, target, _header.FilterDistance))
        {
            throw Error($"filter type {line[0]}, expected 0 to 4");
        }
    }

    private void Convert(ReadOnlySpan<byte> samples, Span<byte> pixels)
    {
        if (!_converter.TryConvert(samples, pixels))
        {
            throw Error("a pixel's colour is beyond the palette");
        }
    }

    private void Scatter(ReadOnlySpan<byte> pixels, PngPass pass, int y)
    {
        var row = Row(y)[(4 * pass.Left)..];
        for (var i = 0; i < pixels.Length; i += 4)
        {
            pixels.Slice(i, 4).CopyTo(row[(i * pass.StepX)..]);
        }
    }

    private PngException Error(string problem, Exception? inner = null) => new(_chunks.Position, problem, inner);
}
