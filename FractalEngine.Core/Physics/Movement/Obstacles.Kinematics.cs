using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Movement;

/// <content>Obstacles that move by themselves, each where it is at the time of the step.</content>
internal sealed partial class Obstacles
{
    /// <summary>Seconds since the beginning of the step, at which kinematic objects are asked for.</summary>
    public double Time
    {
        get => kinematics.Time;
        set
        {
            if (HasKinematics)
            {
                // Threads share it: a time that none asks for would be passed to and fro between their caches.
                kinematics.Time = value;
            }
        }
    }

    /// <summary>True where there are objects that move by themselves.</summary>
    public bool HasKinematics => kinematics.Objects.Count > 0;

    /// <summary>Largest speed of the kinematic objects that the mover may meet; 0 where there are none.</summary>
    /// <param name="motion">Path of the mover.</param>
    /// <param name="duration">Seconds that it takes.</param>
    public double MaxKinematicSpeed(in SphereMotion motion, double duration)
    {
        if (kinematics.Objects.Count == 0 || _staticColliders is null)
        {
            return 0;
        }

        var reach = 0.0;
        foreach (var sphere in _sphereOffsets)
        {
            reach = Math.Max(reach, sphere.Length());
        }

        return kinematics.MaxSpeedNear(in motion, duration, (_radius * ContactTolerances.NeighbourRadiusFactor) + reach);
    }

    /// <summary>Finds the closest kinematic object.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="contact">The surface, if there is one.</param>
    /// <returns>False where none is within the distance.</returns>
    public bool TryFindNearKinematic(Vector position, double maxDistance, out Contact contact) =>
        TryFindCloserKinematic(position, ref maxDistance, out contact);

    /// <summary>Finds the static object with the surface closest to a point.</summary>
    /// <param name="point">World space.</param>
    /// <param name="maxDistance">Largest distance of interest.</param>
    /// <param name="index">Its index among the static objects.</param>
    public bool TryFindObject(Vector point, double maxDistance, out int index) =>
        TryFindClosestPoint(point, maxDistance, out _, out index, out _);

    private Contact CreateSurfaceContact(Vector point, Vector sphere, bool isFlat, KinematicObject? kinematic) =>
        new(kinematic?.ToReference(point) ?? point, _radius, sphere, Contact.NoBody, isFlat) { Kinematic = kinematic };

    private bool TryFindCloserKinematic(Vector position, ref double maxDistance, out Contact contact)
    {
        contact = default;
        var isFound = false;
        if (_staticColliders is null || kinematics.Objects.Count == 0)
        {
            return false;
        }

        foreach (var sphere in _sphereOffsets)
        {
            ClosestPoint closest = default;
            KinematicObject? found = null;
            if (TryFindOnKinematics(position + sphere, maxDistance + _radius, ref closest, ref found))
            {
                contact = CreateSurfaceContact(closest.Point, sphere, closest.Feature == TriangleFeature.Interior, found);
                maxDistance = closest.Distance - _radius;
                isFound = true;
            }
        }

        return isFound;
    }

    private bool TryFindStaticPoint(Vector point, double maxDistance, out ClosestPoint closest) =>
        _staticColliders!.Scene.TryFindClosest(point, maxDistance, queryContext, out closest);

    private bool TryFindOnKinematics(Vector point, double maxDistance, ref ClosestPoint closest, ref KinematicObject? found)
    {
        var isFound = false;
        foreach (var (kinematic, collider) in _staticColliders!.Kinematics)
        {
            var local = kinematic.ToReference(point);
            if (maxDistance >= 0 && kinematic.IsNear(local, maxDistance)
                && collider.TryFindClosest(local, maxDistance, queryContext, out var candidate, epsilon: 0)
                && (!isFound || candidate.Distance < maxDistance))
            {
                closest = candidate with { Point = kinematic.ToWorld(candidate.Point), Normal = kinematic.Rotate(candidate.Normal) };
                maxDistance = candidate.Distance;
                found = kinematic;
                isFound = true;
            }
        }

        return isFound;
    }
}
