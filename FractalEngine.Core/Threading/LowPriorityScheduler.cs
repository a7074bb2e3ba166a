using System.Collections.Concurrent;
using System.Runtime.InteropServices;

namespace FractalEngine.Core.Threading;

/// <summary>Runs tasks on threads of its own, one a core, which leave the cores to all other threads that need them.</summary>
public sealed class LowPriorityScheduler : TaskScheduler, IDisposable
{
    // Of Linux, which ignores the priorities of .NET: the niceness of the calling thread, from 0 to 19.
    private const int OfThread = 0;
    private const int CallingThread = 0;
    private const int Niceness = 10;

    private readonly BlockingCollection<Task> _tasks = [];
    private readonly Thread[] _threads;

    /// <summary>Starts the threads, which sleep until there is a task.</summary>
    public LowPriorityScheduler()
    {
        _threads = [.. Enumerable.Range(0, Environment.ProcessorCount).Select(_ => new Thread(ExecuteTasks)
        {
            IsBackground = true,
            Name = "low priority",
            Priority = ThreadPriority.BelowNormal,
        })];
        foreach (var thread in _threads)
        {
            thread.Start();
        }
    }

    /// <inheritdoc/>
    public override int MaximumConcurrencyLevel => _threads.Length;

    /// <summary>Ends the threads after the tasks that are queued. No further task may be queued.</summary>
    public void Dispose() => _tasks.CompleteAdding();

    /// <inheritdoc/>
    protected override void QueueTask(Task task)
    {
        ObjectDisposedException.ThrowIf(_tasks.IsAddingCompleted, this);
        _tasks.Add(task);
    }

    /// <inheritdoc/>
    protected override bool TryExecuteTaskInline(Task task, bool taskWasPreviouslyQueued) =>
        Array.IndexOf(_threads, Thread.CurrentThread) >= 0 && TryExecuteTask(task);

    /// <inheritdoc/>
    protected override IEnumerable<Task> GetScheduledTasks() => [.. _tasks];

    private void ExecuteTasks()
    {
        if (OperatingSystem.IsLinux())
        {
            // Where it is refused, the threads have the priority of all others, which is no error.
            _ = SetPriority(OfThread, CallingThread, Niceness);
        }

        foreach (var task in _tasks.GetConsumingEnumerable())
        {
            TryExecuteTask(task);
        }
    }

    [DllImport("libc", EntryPoint = "setpriority")]
    private static extern int SetPriority(int which, int who, int niceness);
}
