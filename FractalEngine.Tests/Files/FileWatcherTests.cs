using System.Collections.Immutable;
using System.Diagnostics;
using FractalEngine.Core.Files;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Files;

public sealed class FileWatcherTests : IDisposable
{
    private readonly TemporaryFolder _folder = new();
    private readonly FileWatcher _watcher = new(static () => { });

    public void Dispose()
    {
        _watcher.Dispose();
        _folder.Dispose();
    }

    [SkippableFact]
    public void Stamp_OfAFileFromAfterTheYear9999_IsThatOfAFile()
    {
        const string memory = "/dev/shm";
        Elsewhere.SkipIf(!Directory.Exists(memory), "there is no file system that keeps such times");
        var path = Path.Combine(memory, Path.GetRandomFileName());
        try
        {
            File.WriteAllText(path, "1");
            using var touch = Process.Start("touch", ["-d", "@99999999999999", path]);
            touch.WaitForExit();
            Assert.Equal(1, FileStamp.Of(path).Length);
        }
        finally
        {
            File.Delete(path);
        }
    }

    [Fact]
    public void Watcher_OfAChange_ReportsItOnceAfterItHasSettled()
    {
        var path = _folder.Write("a", "1");
        Watch(path);
        for (var i = 0; i < 20; i++)
        {
            File.AppendAllText(path, "2");
            Thread.Sleep(10);
            Assert.False(_watcher.TakeChange(), "reported while the file was being written");
        }

        Polling.WaitUntil(_watcher.TakeChange, "change");
        Thread.Sleep(600);
        Assert.False(_watcher.TakeChange());
        Watch(path);
        Thread.Sleep(600);
        Assert.False(_watcher.TakeChange());
    }

    [Fact]
    public void Watcher_OfFilesThatAppearAndFoldersThatVanish_ReportsThem()
    {
        var missing = _folder["inner/missing"];
        Watch(missing);
        _folder.Write("inner/missing", "1");
        Polling.WaitUntil(_watcher.TakeChange, "file that appeared");
        Watch(missing);
        Directory.Delete(_folder["inner"], recursive: true);
        Polling.WaitUntil(_watcher.TakeChange, "folder that vanished");
    }

    [Fact]
    public void Watcher_OfAFileThatIsRecreatedAsItWas_ReportsNothingInBetween()
    {
        var path = _folder.Write("a", "1");
        Watch(path);
        File.Delete(path);
        Thread.Sleep(120);
        Assert.False(_watcher.TakeChange());
        _folder.Write("a", "1");
        Polling.WaitUntil(_watcher.TakeChange, "recreated file");
    }

    /// <summary>As on a network that has gone: the window asks on its own thread, and must not wait.</summary>
    [Fact]
    public async Task Watcher_WhileAFileCantBeExamined_LetsNobodyWait()
    {
        var path = _folder.Write("a", "1");
        using var hasBegun = new ManualResetEventSlim();
        using var end = new ManualResetEventSlim();
        using var watcher = new FileWatcher(static () => { }, stampOf: file =>
        {
            hasBegun.Set();
            end.Wait();
            return FileStamp.Of(file);
        });
        watcher.Watch(ImmutableDictionary<string, FileStamp>.Empty.Add(path, FileStamp.Missing));
        Assert.True(hasBegun.Wait(Polling.Deadline));
        var asks = Task.Factory.StartNew(watcher.TakeChange, default, TaskCreationOptions.LongRunning, TaskScheduler.Default);
        await Task.WhenAny(asks, Task.Delay(TimeSpan.FromSeconds(5)));
        var isAnswered = asks.IsCompleted;
        end.Set();
        Assert.True(isAnswered, "waited for the file");
        Assert.False(await asks);
        Polling.WaitUntil(watcher.TakeChange, "change");
    }

    /// <summary>Looking at many files, or at those of a network, takes a fiftieth of the time at most.</summary>
    [Theory]
    [InlineData(0, 100)]
    [InlineData(2, 100)]
    [InlineData(10, 500)]
    public void Watcher_OfFilesThatTakeLong_LooksLessOften(int milliseconds, int expected)
    {
        var time = new ManualTime();
        using var watcher = new FileWatcher(static () => { }, time, _ =>
        {
            time.Now += milliseconds;
            return FileStamp.Missing;
        });
        watcher.Watch(ImmutableDictionary<string, FileStamp>.Empty.Add("a", FileStamp.Missing));
        Assert.Equal(TimeSpan.Zero, time.Due);
        time.Fire();
        Assert.Equal(TimeSpan.FromMilliseconds(expected), time.Due);
    }

    private void Watch(string path) => _watcher.Watch(ImmutableDictionary<string, FileStamp>.Empty.Add(path, FileStamp.Of(path)));

    /// <summary>A clock in milliseconds with one timer, which goes off when it is told to.</summary>
    private sealed class ManualTime : TimeProvider, ITimer
    {
        private TimerCallback? _callback;

        public long Now { get; set; }

        public TimeSpan Due { get; private set; }

        public override long TimestampFrequency => 1000;

        public override long GetTimestamp() => Now;

        public override ITimer CreateTimer(TimerCallback callback, object? state, TimeSpan dueTime, TimeSpan period)
        {
            _callback = callback;
            return this;
        }

        public bool Change(TimeSpan dueTime, TimeSpan period)
        {
            Due = dueTime;
            return true;
        }

        public void Fire() => _callback!(null);

        public void Dispose()
        {
        }

        public ValueTask DisposeAsync() => default;
    }
}
