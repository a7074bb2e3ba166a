using System.Runtime.CompilerServices;
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
    private object? _target;
    private Delegate? _job;
    private Action<object, Delegate, int>? _invoke;
    private ExceptionDispatchInfo? _fault;
    private int _faultIndex;

    /// <summary>The threads of this process, made when they are first needed.</summary>
    public static WorkerSet Shared { get; } = new();

    /// <summary>Does jobs, and returns when all are done.</summary>
    /// <param name="count">Number of jobs, less than 65,536.</param>
    /// <param name="maxThreads">Number of threads that may work on them, the caller's included.</param>
    /// <param name="target">What the job is done by.</param>
    /// <param name="job">Does the job of an index. A static lambda is made once, and needs no field that keeps it.</param>
    /// <exception cref="Exception">That of the job with the lowest index that failed.</exception>
    public void Run<T>(int count, int maxThreads, T target, Action<T, int> job)
        where T : class
    {
        if (count < 2 || maxThreads < 2 || Interlocked.Exchange(ref _isBusy, 1) != 0)
        {
            for (var i = 0; i < count; i++)
            {
                job(target, i);
            }

            return;
        }

        try
        {
            (_target, _job, _invoke) = (target, job, Invoker<T>.Invoke);
            RunOnAll(count, Math.Min(maxThreads, count));
        }
        finally
        {
            Volatile.Write(ref _isBusy, 0);
        }
    }

    private void RunOnAll(int count, int threadCount)
    {
        Start(threadCount - 1);
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

        (_target, _job) = (null, null);
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
            _invoke!(_target!, _job!, index);
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

    /// <summary>Calls a job of whose types the threads know nothing.</summary>
    private static class Invoker<T>
        where T : class
    {
        public static readonly Action<object, Delegate, int> Invoke =
            static (target, job, index) => Unsafe.As<Action<T, int>>(job)(Unsafe.As<T>(target), index);
    }
}
