using FractalEngine.Core.Threading;

namespace FractalEngine.Tests.Threading;

/// <summary>Threads that share out the jobs of a step.</summary>
public class WorkerSetTests
{
    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(5)]
    public void Run_DoesEachJobOnce(int maxThreads)
    {
        // Many calls in a row: workers come late to some, when the next one has begun.
        for (var call = 0; call < 3000; call++)
        {
            var counts = new int[1 + (call % 40)];
            WorkerSet.Shared.Run(counts.Length, maxThreads, i => Interlocked.Increment(ref counts[i]));
            Assert.All(counts, count => Assert.Equal(1, count));
        }
    }

    [Fact]
    public void Run_FromManyThreads_DoesEachJobOnce() => Parallel.For(0, 8, _ =>
    {
        for (var call = 0; call < 500; call++)
        {
            var counts = new int[20];
            WorkerSet.Shared.Run(counts.Length, 3, i => Interlocked.Increment(ref counts[i]));
            Assert.All(counts, count => Assert.Equal(1, count));
        }
    });

    [Fact]
    public void Run_OfAJobThatFails_DoesAllOthersAndThrows()
    {
        var counts = new int[50];
        void Fail(int i)
        {
            Interlocked.Increment(ref counts[i]);
            if (i % 20 == 7)
            {
                throw new InvalidOperationException($"job {i}");
            }
        }

        var exception = Assert.Throws<InvalidOperationException>(() => new WorkerSet().Run(counts.Length, 3, Fail));
        Assert.Equal("job 7", exception.Message);
        Assert.All(counts, count => Assert.Equal(1, count));
    }

    /// <summary>Two jobs that wait for each other: each call has a second thread, also after a job has failed.</summary>
    [Fact]
    public void Run_AgainAndAgain_HasMoreThreadsEachTime()
    {
        var workers = new WorkerSet();
        for (var call = 0; call < 5; call++)
        {
            using var barrier = new Barrier(2);
            var fails = call == 2;
            void Meet(int i)
            {
                // Far longer than any thread waits for a core.
                Assert.True(barrier.SignalAndWait(TimeSpan.FromSeconds(30)), $"job {i} of call {call} is alone");
                if (fails)
                {
                    throw new InvalidOperationException("failed");
                }
            }

            var exception = Record.Exception(() => workers.Run(2, 2, Meet));
            Assert.Equal(fails ? "failed" : null, exception?.Message);
        }
    }

    /// <summary>Threads that an earlier call has made wait while a later one may have fewer.</summary>
    [Fact]
    public void Run_OnFewerThreadsThanBefore_HasNoMoreThanThose()
    {
        var workers = new WorkerSet();
        using (var barrier = new Barrier(5))
        {
            workers.Run(5, 5, _ => Assert.True(barrier.SignalAndWait(TimeSpan.FromSeconds(30)), "too few threads"));
        }

        for (var call = 0; call < 20; call++)
        {
            var threads = new int[60];
            workers.Run(threads.Length, 2, i =>
            {
                threads[i] = Environment.CurrentManagedThreadId;
                Thread.Sleep(i < 30 ? 1 : 0);
            });
            Assert.InRange(threads.Distinct().Count(), 1, 2);
        }
    }

    [Fact]
    public void Run_WithinAJob_DoesItsJobsOnTheSameThread()
    {
        var workers = new WorkerSet();
        var threads = new int[20, 20];
        workers.Run(20, 4, i => workers.Run(20, 4, j => threads[i, j] = Environment.CurrentManagedThreadId));
        for (var i = 0; i < 20; i++)
        {
            Assert.Single(Enumerable.Range(0, 20).Select(j => threads[i, j]).Distinct());
        }
    }

    [Theory]
    [InlineData(1, 5)]
    [InlineData(0, 5)]
    [InlineData(9, 1)]
    public void Run_OfOneJobOrOneThread_StaysOnTheCallersThread(int count, int maxThreads)
    {
        var own = Environment.CurrentManagedThreadId;
        var order = new List<int>();
        new WorkerSet().Run(count, maxThreads, i =>
        {
            Assert.Equal(own, Environment.CurrentManagedThreadId);
            order.Add(i);
        });
        Assert.Equal(Enumerable.Range(0, count), order);
    }
}

/// <summary>Jobs that need no target.</summary>
internal static class WorkerSetExtensions
{
    public static void Run(this WorkerSet workers, int count, int maxThreads, Action<int> job) =>
        workers.Run(count, maxThreads, job, static (act, index) => act(index));
}
