using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Bodies;

/// <summary>The surfaces near a ball that it does not touch, each once.</summary>
public sealed class NearSurfaceListTests
{
    [Fact]
    public void Add_OfSurfaces_KeepsThoseThatAreNotKnown()
    {
        var contacts = new ContactSet();
        contacts.Add(Surface(-0.5 * Vector.J), Vector.Zero);
        contacts.Add(Surface(-0.5 * Vector.I) with { BodyIndex = 3 }, Vector.Zero);
        var list = new NearSurfaceList();
        // It is touched already; and up to a cosine of 0.999, two and a half degrees, it counts as the same.
        list.Add(Surface(-Vector.J), Vector.J, contacts, Vector.Zero);
        list.Add(Surface(-Vector.J), Turned(2.5), contacts, Vector.Zero);
        Assert.Equal(0, list.Count);
        list.Add(Surface(-Vector.J), Turned(2.6), contacts, Vector.Zero);
        Assert.Equal(1, list.Count);
        list.Add(Surface(-9 * Vector.J), Turned(5), contacts, Vector.Zero);
        Assert.Equal(1, list.Count);
        // Bodies are no surfaces.
        list.Add(Surface(-Vector.I), Vector.I, contacts, Vector.Zero);
        Assert.Equal((2, Vector.I, -Vector.I), (list.Count, list[1].CachedNormal, list[1].FixedPoint));
        Near.Equal(Turned(2.6), list[0].CachedNormal, 1e-15);
        list.Add(Surface(-Vector.K), Vector.K, contacts, Vector.Zero);
        list.Add(Surface(Vector.K), -Vector.K, contacts, Vector.Zero);
        Assert.Equal(NearSurfaceList.Capacity, list.Count);
        list.Add(Surface(Vector.I), -Vector.I, contacts, Vector.Zero);
        Assert.Equal(NearSurfaceList.Capacity, list.Count);
        list.Clear();
        Assert.Equal(0, list.Count);
    }

    [Fact]
    public void HasMovingSurface_OfSurfaces_TellsWhetherAnyCarries()
    {
        var plate = new PhysicsWorld().AddStatic(PhysicsMeshes.Cube);
        plate.SetBelt(Vector.I);
        var list = new NearSurfaceList();
        var contacts = new ContactSet();
        list.Add(Surface(-Vector.J), Vector.J, contacts, Vector.Zero);
        Assert.False(list.HasMovingSurface);
        // This one is of another object, which may go away from the first one.
        list.Add(Surface(-Vector.J) with { Kinematic = plate.Kinematic }, Vector.J, contacts, Vector.Zero);
        list.Add(Surface(-Vector.I), Vector.I, contacts, Vector.Zero);
        Assert.Equal((3, true), (list.Count, list.HasMovingSurface));
        plate.SetBelt(Vector.Zero);
        Assert.False(list.HasMovingSurface);
    }

    private static Vector Turned(double degrees) => new(Math.Sin(degrees * Math.PI / 180), Math.Cos(degrees * Math.PI / 180), 0);

    private static Contact Surface(Vector point) => new(point, 0.5, Vector.Zero, Contact.NoBody, IsFlat: true);
}
