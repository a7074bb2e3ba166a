using FractalEngine.Core.Physics;

namespace FractalEngine.Tests.Physics;

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
}
