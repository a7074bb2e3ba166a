using System.Globalization;
using FractalEngine.Core.Files;

namespace FractalEngine.Core.Images.Animations;

/// <summary>Frames as files of their own: <c>frames-0001.png</c> and so on, each written whole.</summary>
/// <param name="path">Path to which the numbers are added.</param>
/// <param name="frameCount">Number of all frames, which gives the number of digits.</param>
internal sealed class NumberedImages(string path, int frameCount) : AnimationOutput
{
    private const int MinDigits = 4;

    private readonly int _digits = Math.Max(MinDigits, frameCount.ToString(CultureInfo.InvariantCulture).Length);
    private int _count;

    /// <inheritdoc/>
    public override string Name => $"{PathOf(1)} to {Path.GetFileName(PathOf(_count))}";

    /// <inheritdoc/>
    public override IEnumerable<string> Files => Enumerable.Range(1, frameCount).Select(PathOf);

    /// <inheritdoc/>
    public override void Add(PixelImage frame) => AddFile(stream => PngWriter.Write(frame, stream));

    /// <inheritdoc/>
    public override void AddFile(Action<Stream> write)
    {
        AtomicFile.Write(PathOf(_count + 1), write);
        _count++;
    }

    /// <inheritdoc/>
    public override void Complete()
    {
    }

    private string PathOf(int number) =>
        $"{Path.ChangeExtension(path, null)}-{number.ToString($"D{_digits}", CultureInfo.InvariantCulture)}{Path.GetExtension(path)}";
}
