using System.Diagnostics;
using System.Globalization;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Images.Animations;

/// <summary>Frames as a video, which the program <c>ffmpeg</c> encodes.</summary>
internal sealed class Video : AnimationOutput
{
    // The colours of high definition, which players expect of sides as large as ours. Without a word, the encoder takes older ones.
    private const string ToBt709 = "scale=out_color_matrix=bt709:out_range=tv";

    private static readonly string[] FormatArguments =
        ["-pix_fmt", "yuv420p", "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"];

    private readonly string _unfinishedPath;
    private readonly Process _encoder;
    private readonly Task<string> _messages;

    /// <summary>Starts the program that encodes the video.</summary>
    /// <param name="path">Path of the video, whose ending chooses the format.</param>
    /// <param name="framesPerSecond">Frames a second.</param>
    /// <exception cref="IOException">ffmpeg is not installed.</exception>
    public Video(string path, double framesPerSecond) : base(path)
    {
        Directory.CreateDirectory(Path.GetDirectoryName(Path.GetFullPath(path))!);
        // A name of its own, since the encoder replaces what it finds. It chooses the format by the ending.
        _unfinishedPath = Path.Combine(Path.GetDirectoryName(path) ?? "", $"{Guid.NewGuid():N}.unfinished{Path.GetExtension(path)}");
        string[] arguments =
        [
            "-loglevel", "error", "-y", "-f", "image2pipe", "-c:v", "png",
            "-framerate", framesPerSecond.ToString("R", CultureInfo.InvariantCulture), "-i", "-",
            // Most players need this format of pixels, and it needs even sides.
            .. path.EndsWith(".mp4", StringComparison.OrdinalIgnoreCase)
                ? (string[])["-vf", $"pad=ceil(iw/2)*2:ceil(ih/2)*2,{ToBt709}", .. FormatArguments]
                : path.EndsWith(".webm", StringComparison.OrdinalIgnoreCase) ? ["-vf", ToBt709, .. FormatArguments]
                : [],
            // A name with a colon would be a protocol, and one with a dash an option.
            $"file:{_unfinishedPath}",
        ];
        var start = new ProcessStartInfo("ffmpeg", arguments) { RedirectStandardInput = true, RedirectStandardError = true };
        try
        {
            _encoder = Process.Start(start)!;
        }
        catch (ExternalException)
        {
            // There is no such program.
            throw new IOException($"{path} needs the program ffmpeg, which is not installed; .png and .apng need none");
        }

        _messages = _encoder.StandardError.ReadToEndAsync();
    }

    /// <inheritdoc/>
    /// <exception cref="IOException">The encoder has failed.</exception>
    public override void Add(PixelImage frame)
    {
        ThrowIfDisposed();
        try
        {
            PngWriter.Write(frame, _encoder.StandardInput.BaseStream);
        }
        catch (IOException)
        {
            throw Failure();
        }
    }

    /// <inheritdoc/>
    /// <exception cref="IOException">The encoder has failed.</exception>
    public override void Complete(bool isPartial = false)
    {
        ThrowIfDisposed();
        _encoder.StandardInput.Close();
        _encoder.WaitForExit();
        if (_encoder.ExitCode != 0)
        {
            throw Failure();
        }

        Save(stream =>
        {
            using var video = File.OpenRead(_unfinishedPath);
            video.CopyTo(stream);
        }, isPartial);
    }

    /// <inheritdoc/>
    public override void Dispose()
    {
        if (IsDisposed)
        {
            return;
        }

        if (!_encoder.HasExited)
        {
            _encoder.Kill();
            _encoder.WaitForExit();
        }

        File.Delete(_unfinishedPath);
        _encoder.Dispose();
        base.Dispose();
    }

    private IOException Failure()
    {
        var message = _messages.Wait(TimeSpan.FromSeconds(2)) ? _messages.Result.Trim().ReplaceLineEndings(" ") : "";
        return new($"{Name} can't be written: ffmpeg {(message.Length > 0 ? $"says: {message}" : "has ended")}");
    }
}
