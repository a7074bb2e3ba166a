namespace FractalEngine.App.Shell;

/// <summary>A stream that may be closed or full, with its own way to report errors.</summary>
/// <param name="open">Opens the stream when it is first written.</param>
/// <param name="report">Receives each error of opening and writing.</param>
internal sealed class StandardStream(Func<Stream> open, Action<Exception> report) : WriteOnlyStream
{
    private Stream? _target;

    public override void Flush()
    {
    }

    public override void Write(ReadOnlySpan<byte> buffer)
    {
        try
        {
            _target ??= open();
            _target.Write(buffer);
            _target.Flush();
        }
        catch (Exception exception)
            when (exception is IOException or UnauthorizedAccessException or ObjectDisposedException or ArgumentOutOfRangeException)
        {
            // The last is how the runtime reports a file that is too large for the system.
            report(exception);
        }
    }
}
