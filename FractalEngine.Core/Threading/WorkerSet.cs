using System.Runtime.ExceptionServices;

namespace FractalEngine.Core.Threading;

/// <summary>
/// Threads that stay between calls and share out independent jobs. The caller works too, and waits only for jobs that another thread has
/// begun. A call allocates nothing.
/// </summary>
/// <remarks>
/// Jobs are taken one by one, so which thread does which is chance. A job must depend on its index alone, and write to nothing that
/// another one reads. All worlds of a process have the same threads: one world has them at a time, and others do their jobs alone.
/// </remarks>
internal sealed class WorkerSet
{
    // A worker that waits longer for the next jobs sleeps. Within a step they follow each other in a few microseconds.
    private const int MaxSpins = 60;
    private const int IterationsPerSpin = 20;

    // Bits of a number of jobs.
    private const int CountBits = 16;
    private const int CountMask = (1 << CountBits) - 1;

    // A job that takes longer may wait for a core.
    private const int MaxSpinsForLastJob = 30;

    private readonly object _wakeUp = new();
    private readonly Lock _faultLock = new();
    private Thread[] _threads = [];
    private int _isBusy;
    private int _sleepers;

    // Number of calls in the upper half, then of jobs of the present call, then the next of these: at once, so that none is taken twice.
    private long _state;
    private int _pending;
    private int _helpers;
    private Action<int>? _job;
    private ExceptionDispatchInfo? _fault;
    private int _faultIndex;

    /// <summary>The threads of this process, made when they are first needed.</summary>
    public static WorkerSet Shared { get; } = new();

    /// <summary>Does jobs, and returns when all are done.</summary>
    /// <param name="count">Number of jobs, less than 65,536.</param>
    /// <param name="maxThreads">Number of threads that may work on them, the caller's included.</param>
    /// <param name="job">Does the job of an index.</param>
    /// <exception cref="Exception">That of the job with the lowest index that failed.</exception>
    public void Run(int count, int maxThreads, Action<int> job)
    {
        if (count < 2 || maxThreads < 2 || Interlocked.Exchange(ref _isBusy, 1) != 0)
        {
            for (var i = 0; i < count; i++)
            {
                job(i);
            }

            return;
        }

        try
        {
            RunOnAll(count, Math.Min(maxThreads, count), job);
        }
        finally
        {
            Volatile.Write(ref _isBusy, 0);
        }
    }

    private void RunOnAll(int count, int threadCount, Action<int> job)
    {
        Start(threadCount - 1);
        _job = job;
        _helpers = threadCount - 1;
        _fault = null;
        _pending = count;
        var call = CallOf(_state) + 1;
        Interlocked.Exchange(ref _state, ((long)call << (2 * CountBits)) | ((long)count << CountBits));
        if (Volatile.Read(ref _sleepers) > 0)
        {
            lock (_wakeUp)
            {
                Monitor.PulseAll(_wakeUp);
            }
        }

        Work(call);
        for (var spins = 0; Volatile.Read(ref _pending) > 0; spins++)
        {
            if (spins < MaxSpinsForLastJob)
            {
                Thread.SpinWait(IterationsPerSpin);
            }
            else
            {
                Thread.Yield();
            }
        }

        _job = null;
        _fault?.Throw();
    }

    private void Start(int helperCount)
    {
        if (_threads.Length >= helperCount)
        {
            return;
        }

        var first = _threads.Length;
        Array.Resize(ref _threads, helperCount);
        for (var i = first; i < helperCount; i++)
        {
            var index = i;
            _threads[i] = new(() => Serve(index)) { IsBackground = true, Name = $"physics {i + 1}" };
            _threads[i].Start();
        }
    }

    private void Serve(int index)
    {
        var lastCall = 0;
        while (true)
        {
            lastCall = WaitForCall(lastCall);
            if (index < Volatile.Read(ref _helpers))
            {
                Work(lastCall);
            }
        }
    }

    private int WaitForCall(int lastCall)
    {
        while (true)
        {
            for (var spins = 0; spins < MaxSpins; spins++)
            {
                var call = CallOf(Volatile.Read(ref _state));
                if (call != lastCall)
                {
                    return call;
                }

                Thread.SpinWait(IterationsPerSpin);
            }

            lock (_wakeUp)
            {
                Interlocked.Increment(ref _sleepers);
                while (CallOf(Volatile.Read(ref _state)) == lastCall)
                {
                    Monitor.Wait(_wakeUp);
                }

                Interlocked.Decrement(ref _sleepers);
            }
        }
    }

    /// <summary>Takes jobs of a call until none is left.</summary>
    private void Work(int call)
    {
        while (true)
        {
            var state = Volatile.Read(ref _state);
            var index = (int)state & CountMask;
            if (CallOf(state) != call || index >= ((int)(state >> CountBits) & CountMask))
            {
                return;
            }

            if (Interlocked.CompareExchange(ref _state, state + 1, state) == state)
            {
                Do(index);
            }
        }
    }

    private static int CallOf(long state) => (int)(state >> (2 * CountBits));

    private void Do(int index)
    {
        try
        {
            _job!(index);
        }
        catch (Exception exception)
        {
            // Whatever it is: the caller has it.
            lock (_faultLock)
            {
                if (_fault is null || index < _faultIndex)
                {
                    _fault = ExceptionDispatchInfo.Capture(exception);
                    _faultIndex = index;
                }
            }
        }
        finally
        {
            Interlocked.Decrement(ref _pending);
        }
    }
}
