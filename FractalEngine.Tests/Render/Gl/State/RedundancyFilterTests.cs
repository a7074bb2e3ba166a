using FractalEngine.Render.Gl.State;

namespace FractalEngine.Tests.Render.Gl.State;

public sealed class RedundancyFilterTests
{
    [Fact]
    public void Update_SameValue_IsSkippedAndCounted()
    {
        var filter = new RedundancyFilter();
        var current = 0;
        Assert.Equal([false, true, false, true], ((int[])[0, 1, 1, 0]).Select(value => filter.Update(ref current, value)));
        Assert.Equal(new(2, 2), filter.Counts);
    }

    [Fact]
    public void ShouldPerform_SeveralOperations_CountsEachOfThem()
    {
        var filter = new RedundancyFilter();
        Assert.False(filter.ShouldPerform(isRedundant: true, 3));
        Assert.True(filter.ShouldPerform(isRedundant: false, 2));
        Assert.Equal(new(2, 3), filter.Counts);
    }

    [Fact]
    public void Update_Disabled_PerformsEverythingAndKeepsTheValue()
    {
        var filter = new RedundancyFilter { IsEnabled = false };
        var current = 0;
        Assert.Equal([true, true, true], ((int[])[0, 1, 1]).Select(value => filter.Update(ref current, value)));
        filter.IsEnabled = true;
        Assert.False(filter.Update(ref current, 1));
        Assert.Equal(new(3, 1), filter.Counts);
    }
}
