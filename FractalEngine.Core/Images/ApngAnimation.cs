using System.Buffers.Binary;

namespace FractalEngine.Core.Images;

/// <summary>
/// Collects images and writes them as an animated PNG that repeats for ever (PNG, third edition, §11.3.6). A reader of still images shows
/// the first one.
/// </summary>
/// <remarks>Holds the compressed images until they are written, since their number stands before them.</remarks>
public sealed class ApngAnimation
{
    // The delay is a fraction of two 16-bit numbers: hundredths of a frame per second over a hundred.
    private const ushort DelayNumerator = 100;

    private const int AnimationControlBytes = 8;
    private const int FrameControlBytes = 26;
    private const int SequenceNumberBytes = 4;

    private readonly ushort _delayDenominator;
    private readonly List<byte[]> _frames = [];
    private PixelImage? _first;

    /// <summary>Creates an animation without images.</summary>
    /// <param name="framesPerSecond">Images a second, from 0.01 to 655.</param>
    /// <exception cref="ArgumentOutOfRangeException">The number is out of its range.</exception>
    public ApngAnimation(double framesPerSecond)
    {
        ArgumentOutOfRangeException.ThrowIfLessThan(framesPerSecond, 0.01);
        ArgumentOutOfRangeException.ThrowIfGreaterThan(framesPerSecond, 655);
        _delayDenominator = (ushort)Math.Round(framesPerSecond * DelayNumerator);
    }

    /// <summary>Number of images so far.</summary>
    public int FrameCount => _frames.Count;

    /// <summary>Adds an image behind the others.</summary>
    /// <param name="image">Of the same size as the others.</param>
    /// <exception cref="ArgumentException">The image has another size than the first one.</exception>
    public void Add(PixelImage image)
    {
        ArgumentNullException.ThrowIfNull(image);
        _first ??= image;
        if ((image.Width, image.Height) != (_first.Width, _first.Height))
        {
            throw new ArgumentException($"expected {_first.Width}×{_first.Height} pixels, not {image.Width}×{image.Height}", nameof(image));
        }

        using var data = new MemoryStream();
        PngWriter.Compress(image.Pixels, image.Height, 4, data);
        _frames.Add(data.ToArray());
    }

    /// <summary>Writes the animation with all images so far.</summary>
    /// <param name="stream">Where to; left open. Need not seek.</param>
    /// <exception cref="InvalidOperationException">There is no image.</exception>
    /// <exception cref="IOException">The stream can't be written.</exception>
    public void Write(Stream stream)
    {
        ArgumentNullException.ThrowIfNull(stream);
        if (_first is null)
        {
            throw new InvalidOperationException("the animation has no image");
        }

        var chunks = new PngChunkWriter(stream);
        chunks.WriteSignature();
        PngWriter.WriteHeader(_first.Width, _first.Height, chunks);
        Span<byte> control = stackalloc byte[AnimationControlBytes];
        BinaryPrimitives.WriteInt32BigEndian(control, _frames.Count);
        // Zero repetitions mean without end.
        BinaryPrimitives.WriteInt32BigEndian(control[4..], 0);
        chunks.Write(PngChunk.AnimationControl, control);
        var sequenceNumber = 0;
        foreach (var frame in _frames)
        {
            WriteFrame(chunks, frame, ref sequenceNumber);
        }

        chunks.Write(PngChunk.End, []);
    }

    private void WriteFrame(PngChunkWriter chunks, byte[] frame, ref int sequenceNumber)
    {
        var isFirst = sequenceNumber == 0;
        Span<byte> control = stackalloc byte[FrameControlBytes];
        control.Clear();
        BinaryPrimitives.WriteInt32BigEndian(control, sequenceNumber++);
        BinaryPrimitives.WriteInt32BigEndian(control[4..], _first!.Width);
        BinaryPrimitives.WriteInt32BigEndian(control[8..], _first.Height);
        // The frame fills the canvas and replaces what was there, so that offset, disposal and blending stay 0.
        BinaryPrimitives.WriteUInt16BigEndian(control[20..], DelayNumerator);
        BinaryPrimitives.WriteUInt16BigEndian(control[22..], _delayDenominator);
        chunks.Write(PngChunk.FrameControl, control);
        if (isFirst)
        {
            chunks.Write(PngChunk.Data, frame);
            return;
        }

        var data = new byte[SequenceNumberBytes + frame.Length];
        BinaryPrimitives.WriteInt32BigEndian(data, sequenceNumber++);
        frame.CopyTo(data, SequenceNumberBytes);
        chunks.Write(PngChunk.FrameData, data);
    }
}
