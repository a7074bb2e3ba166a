using FractalEngine.App.Window.Tools;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Tools;

/// <summary>Tests where the tool of sections draws what it shows, without a window.</summary>
public class SectionToolTests
{
    [Fact]
    public void MiddleOf_AnyPlane_IsItsPointNearestToTheMiddleOfTheScene() => Seeded.Run(50, random =>
    {
        var plane = new SectionPlane(random.Vector().UnitVector(), random.Between(-3, 3));
        var centre = random.Vector(5);
        var middle = SectionTool.MiddleOf(plane, new(centre - Vector.One, centre + Vector.One));
        Near.Equal(0, plane.SignedDistance(middle), 1e-12);
        Near.Equal(0, Vector.Cross(plane.Normal, middle - centre).Length(), 1e-12);
    });
}
