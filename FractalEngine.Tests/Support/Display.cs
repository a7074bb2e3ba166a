namespace FractalEngine.Tests.Support;

/// <summary>The display that programs under test draw on.</summary>
internal static class Display
{
    private static readonly object Gate = new();
    private static string? _owner;
    private static int _windowCount;
    private static long _nextTicket;
    private static long _servedTicket;

    /// <summary>Skips the test where there is none.</summary>
    public static void Require() => Skip.If(
        OperatingSystem.IsLinux() && string.IsNullOrEmpty(Environment.GetEnvironmentVariable("DISPLAY")), "no display to draw on");

    /// <summary>
    /// Waits until no other collection shows a window: one that opens takes the keyboard from the others. Those who wait are served in
    /// turn.
    /// </summary>
    /// <param name="collection">Collection of the test, which may show several windows.</param>
    /// <returns>Gives the keyboard back when it is disposed.</returns>
    public static IDisposable TakeFocus(string collection)
    {
        lock (Gate)
        {
            if (_windowCount == 0 || _owner != collection)
            {
                for (var ticket = _nextTicket++; _windowCount > 0 || ticket != _servedTicket;)
                {
                    Monitor.Wait(Gate);
                }

                _servedTicket++;
                _owner = collection;
            }

            _windowCount++;
        }

        return new Focus();
    }

    private sealed class Focus : IDisposable
    {
        private bool _isDisposed;

        public void Dispose()
        {
            lock (Gate)
            {
                _windowCount -= _isDisposed ? 0 : 1;
                _isDisposed = true;
                Monitor.PulseAll(Gate);
            }
        }
    }
}
