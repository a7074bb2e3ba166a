using System.Collections.Immutable;

namespace FractalEngine.Core.Files;

/// <summary>
/// Tells when files are no longer as they were loaded, once they have settled: editors truncate, rename, delete and write in parts. What
/// counts is the state of the files, at which it looks ten times a second: notifications of the system do not come from network drives,
/// from folders that vanish, nor from many folders.
/// </summary>
public sealed class FileWatcher : IDisposable
{
    // Looking at thousands of files, or at a network, takes this part of a processor at most.
    private const double MaxLoad = 0.02;

    // Editors that write in parts do so within a few milliseconds.
    private static readonly TimeSpan SettleTime = TimeSpan.FromMilliseconds(50);

    // A file that is missing or empty is probably about to be written.
    private static readonly TimeSpan MissingSettleTime = TimeSpan.FromMilliseconds(300);

    // While files change, and while they do not.
    private static readonly TimeSpan ChangeInterval = TimeSpan.FromMilliseconds(10);
    private static readonly TimeSpan PollInterval = TimeSpan.FromMilliseconds(100);

    private readonly Lock _lock = new();
    private readonly TimeProvider _time;
    private readonly Action _changed;
    private readonly Func<string, FileStamp> _stampOf;
    private readonly ITimer _timer;
    private ImmutableDictionary<string, FileStamp> _loaded = ImmutableDictionary<string, FileStamp>.Empty;
    private ImmutableDictionary<string, FileStamp> _seen = ImmutableDictionary<string, FileStamp>.Empty;
    private long _seenSince;
    private TimeSpan _pollInterval = PollInterval;
    private bool _isReported;
    private bool _isDisposed;

    // While files are examined, which may take long on a network, and whether they must be examined once more then.
    private bool _isChecking;
    private bool _checksAgain;

    /// <summary>Creates a watcher of no files.</summary>
    /// <param name="changed">Called on another thread when <see cref="TakeChange"/> would return true.</param>
    /// <param name="time">The clock; null for that of the system.</param>
    /// <param name="stampOf">Examines a file; null for <see cref="FileStamp.Of"/>.</param>
    public FileWatcher(Action changed, TimeProvider? time = null, Func<string, FileStamp>? stampOf = null)
    {
        _changed = changed;
        _stampOf = stampOf ?? FileStamp.Of;
        _time = time ?? TimeProvider.System;
        _timer = _time.CreateTimer(_ => Check(), null, Timeout.InfiniteTimeSpan, Timeout.InfiniteTimeSpan);
    }

    /// <summary>Watches these files from now on, and no others.</summary>
    /// <param name="files">Full paths of files and folders, with their stamps before they were read.</param>
    /// <exception cref="ObjectDisposedException">The watcher was disposed.</exception>
    public void Watch(ImmutableDictionary<string, FileStamp> files)
    {
        ArgumentNullException.ThrowIfNull(files);
        lock (_lock)
        {
            ObjectDisposedException.ThrowIf(_isDisposed, this);
            _loaded = files;
            _seen = files;
            _isReported = false;
            Schedule(TimeSpan.Zero);
        }
    }

    /// <summary>Returns true once after the files have changed and settled.</summary>
    public bool TakeChange()
    {
        lock (_lock)
        {
            var isReported = _isReported;
            _isReported = false;
            return isReported;
        }
    }

    /// <inheritdoc/>
    public void Dispose()
    {
        lock (_lock)
        {
            _isDisposed = true;
            _timer.Dispose();
        }
    }

    /// <summary>Examines the files without the lock, for which callers would have to wait.</summary>
    private void Check()
    {
        ImmutableDictionary<string, FileStamp> loaded;
        lock (_lock)
        {
            if (_isDisposed)
            {
                return;
            }

            if (_isChecking)
            {
                _checksAgain = true;
                return;
            }

            _isChecking = true;
            loaded = _loaded;
        }

        var start = _time.GetTimestamp();
        var present = loaded.ToImmutableDictionary(static file => file.Key, file => _stampOf(file.Key));
        bool isReported;
        lock (_lock)
        {
            _isChecking = false;
            _pollInterval = TimeSpan.FromTicks(Math.Max(PollInterval.Ticks, (long)(_time.GetElapsedTime(start).Ticks / MaxLoad)));
            var wasReported = _isReported;
            var delay = _isDisposed || !ReferenceEquals(loaded, _loaded) ? TimeSpan.Zero : Compare(present);
            Schedule(_checksAgain ? TimeSpan.Zero : delay);
            _checksAgain = false;
            isReported = _isReported && !wasReported;
        }

        if (isReported)
        {
            _changed();
        }
    }

    /// <summary>Compares the files with what was loaded, and returns when to look again.</summary>
    private TimeSpan Compare(ImmutableDictionary<string, FileStamp> present)
    {
        var now = _time.GetTimestamp();
        if (!AreEqual(present, _seen))
        {
            _seen = present;
            _seenSince = now;
        }

        var changed = _loaded.Where(file => present[file.Key] != file.Value).ToArray();
        if (changed.Length == 0)
        {
            return _pollInterval;
        }

        var settleTime = changed.Any(file => present[file.Key].Length <= 0 && file.Value.Length > 0) ? MissingSettleTime : SettleTime;
        if (_time.GetElapsedTime(_seenSince, now) < settleTime)
        {
            return ChangeInterval;
        }

        // Reported once: further changes count from here on until the files are loaded again.
        _loaded = present;
        _isReported = true;
        return _pollInterval;
    }

    private static bool AreEqual(ImmutableDictionary<string, FileStamp> stamps1, ImmutableDictionary<string, FileStamp> stamps2) =>
        stamps1.All(file => stamps2[file.Key] == file.Value);

    private void Schedule(TimeSpan delay)
    {
        if (!_isDisposed)
        {
            _timer.Change(delay, Timeout.InfiniteTimeSpan);
        }
    }
}
