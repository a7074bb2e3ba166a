using System.Text;
using FractalEngine.Core.Files;

namespace FractalEngine.App.Window.Files;

/// <summary>Reads and writes small texts in the settings folder of the user.</summary>
internal static class UserFile
{
    private const int MaxBytes = 1 << 16;

    private static readonly UTF8Encoding StrictUtf8 = new(encoderShouldEmitUTF8Identifier: false, throwOnInvalidBytes: true);

    /// <summary>Returns the full path of a file; null where the system has no settings folder.</summary>
    public static string? PathOf(string name)
    {
        var folder = Environment.GetFolderPath(Environment.SpecialFolder.ApplicationData, Environment.SpecialFolderOption.DoNotVerify);
        return folder.Length == 0 ? null : Path.Combine(folder, "FractalEngine", name);
    }

    /// <summary>Reads a file. A broken one counts as missing, with a message.</summary>
    /// <param name="path">Full path of the file; null for none.</param>
    /// <param name="fallback">The result for a file that is missing.</param>
    /// <param name="parse">Reads the text; throws an <see cref="InvalidDataException"/> where that is broken.</param>
    /// <param name="subject">What a message is about, with its verb.</param>
    /// <param name="report">Shows the message.</param>
    public static T Read<T>(string? path, T fallback, Func<string, T> parse, string subject, Action<string> report)
    {
        if (path is null || !File.Exists(path))
        {
            return fallback;
        }

        try
        {
            return new FileInfo(path).Length <= MaxBytes
                ? parse(StrictUtf8.GetString(File.ReadAllBytes(path)))
                : throw new InvalidDataException("it is too large");
        }
        catch (Exception exception)
            when (exception is IOException or UnauthorizedAccessException or InvalidDataException or DecoderFallbackException)
        {
            report($"warning: {subject} ignored: {path}: {exception.Message}");
            return fallback;
        }
    }

    /// <summary>Writes a file, and says so where that fails.</summary>
    /// <param name="path">Full path of the file; null to keep nothing.</param>
    /// <param name="text">The text.</param>
    /// <param name="subject">What a message is about.</param>
    /// <param name="report">Shows the message.</param>
    public static void Write(string? path, string text, string subject, Action<string> report)
    {
        try
        {
            if (path is not null)
            {
                var bytes = StrictUtf8.GetBytes(text);
                AtomicFile.Write(path, stream => stream.Write(bytes));
            }
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException or EncoderFallbackException)
        {
            report($"warning: {subject} can't be written: {exception.Message}");
        }
    }
}
