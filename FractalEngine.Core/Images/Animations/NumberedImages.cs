using System.Globalization;
using FractalEngine.Core.Files;

namespace FractalEngine.Core.Images.Animations;

/// <summary>Frames as files of their own: <c>frames-0001.png</c> and so on, each written whole.</summary>
/// <param name="path">Path to which the numbers are added.</param>
/// <param name="frameCount">Number of all frames, which gives the number of digits.</param>
/// <param name="first">Number of the first image.</param>
internal sealed class NumberedImages(string path, int frameCount, int first = 1) : AnimationOutput
{
    private const int MinDigits = 4;

    private readonly int _digits = Math.Max(MinDigits, frameCount.ToString(CultureInfo.InvariantCulture).Length);
    private int _count = first - 1;

    /// <inheritdoc/>
    public override string Name => $"{PathOf(first)} to {Path.GetFileName(PathOf(_count))}";

    /// <inheritdoc/>
    public override IEnumerable<string> Files => Enumerable.Range(first, frameCount + 1 - first).Select(PathOf);

    /// <inheritdoc/>
    public override void Add(PixelImage frame) => AddFile(stream => PngWriter.Write(frame, stream));

    /// <inheritdoc/>
    public override void AddFile(Action<Stream> write)
    {
        ThrowIfDisposed();
        AtomicFile.Write(PathOf(_count + 1), write);
        _count++;
    }

    /// <inheritdoc/>
    public override bool TrySkip(Predicate<string>? isComplete = null)
    {
        var isThere = File.Exists(PathOf(_count + 1)) && isComplete?.Invoke(PathOf(_count + 1)) != false;
        _count += isThere ? 1 : 0;
        return isThere;
    }

    /// <summary>Finds the images of an earlier animation, see <see cref="AnimationOutput.FindNumbered"/>.</summary>
    public static string[] Find(string path)
    {
        var folder = Path.GetDirectoryName(Path.GetFullPath(path))!;
        var (stem, ending) = (Path.GetFileNameWithoutExtension(path) + "-", Path.GetExtension(path));
        string[] numbers = !Directory.Exists(folder) ? [] :
        [
            .. Directory.EnumerateFiles(folder).Select(Path.GetFileName).OfType<string>()
                .Where(name => name.StartsWith(stem, StringComparison.Ordinal) && name.EndsWith(ending, StringComparison.OrdinalIgnoreCase)
                    && name.Length >= stem.Length + MinDigits + ending.Length)
                .Select(name => name[stem.Length..^ending.Length]).Where(static digits => digits.All(char.IsAsciiDigit)),
        ];
        return numbers.MaxBy(static digits => (digits.Length, digits)) is not { } last || !int.TryParse(last, out var count) ? []
            : [.. Enumerable.Range(1, count).Select(number => PathOf(path, number, last.Length))];
    }

    /// <inheritdoc/>
    public override void Complete(bool isPartial = false) => ThrowIfDisposed();

    private string PathOf(int number) => PathOf(path, number, _digits);

    private static string PathOf(string path, int number, int digits) =>
        $"{Path.ChangeExtension(path, null)}-{number.ToString($"D{digits}", CultureInfo.InvariantCulture)}{Path.GetExtension(path)}";
}
