using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Fractals;

/// <summary>Lists the largest instances of what has no end, beside other tests: it takes seconds.</summary>
public class LargestInstanceTests
{
    [Fact]
    public void ListLargest_OfAMapWithoutEnd_Ends() =>
        Assert.Single(InstanceEnumeration.ListLargest(
            [(Samples.Repeated(null, Samples.MoveAndScale(1, 0, 0, 0.5)), AffineMap.Identity)], 9));
}
