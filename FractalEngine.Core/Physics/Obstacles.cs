using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Character;

namespace FractalEngine.Core.Physics;

/// <summary>
/// What one mover can run into: the surfaces of the scene, and those other bodies that are within its reach. Set up anew for each mover and
/// step.
/// </summary>
internal sealed class Obstacles(List<Body> bodies, BodyGrid grid, QueryContext queryContext)
{
    private readonly List<int> _candidates = new(256);
    private StaticObjects? _staticObjects;
    private SafeDistance _safeDistance = new();
    private Vector[] _sphereOffsets = [Vector.Zero];
    private double _radius;
    private double _searchMargin;
    private CharacterController? _character;

    /// <summary>The numbers of the bodies that may be run into, see <see cref="CollectNearbyBodies"/>.</summary>
    public List<int> Candidates => _candidates;

    /// <summary>The mover's radius, scene units.</summary>
    public double Radius => _radius;

    /// <summary>Begins with another mover.</summary>
    /// <param name="staticObjects">As its colliders see them; null where there are none.</param>
    /// <param name="sphereOffsets">The centres of its spheres beside its position.</param>
    /// <param name="radius">Of the spheres.</param>
    /// <param name="safeDistance">What is known already of what is near.</param>
    /// <param name="searchMargin">How far surfaces are looked for beyond what is asked, so that the next steps need not ask.</param>
    /// <param name="character">A player who is in the way; null for none.</param>
    public void SetMover(StaticObjects? staticObjects, Vector[] sphereOffsets, double radius, SafeDistance safeDistance,
        double searchMargin, CharacterController? character = null)
    {
        (_staticObjects, _sphereOffsets, _radius, _safeDistance, _searchMargin, _character) =
            (staticObjects, sphereOffsets, radius, safeDistance, searchMargin, character);
        _candidates.Clear();
    }

    /// <summary>Looks which other bodies are near a way.</summary>
    /// <param name="motion">The way of the mover.</param>
    /// <param name="duration">How long it goes.</param>
    /// <param name="excludedIndex">The mover's own number, −1 for none.</param>
    public void CollectNearbyBodies(in Motion motion, double duration, int excludedIndex)
    {
        _candidates.Clear();
        var box = motion.SweptBox(duration);
        foreach (var sphere in _sphereOffsets)
        {
            box = BoundingBox.Union(box, new(box.Minimum + sphere, box.Maximum + sphere));
        }

        // A little more, for what touches.
        grid.CollectOverlaps(in box, _radius * (1 + 1e-6), excludedIndex, _candidates);
    }

    /// <summary>What counts as touching: the free distances that rounding can't tell from 0.</summary>
    public double TouchTolerance(Vector position) => (1e-9 * _radius) + (1e-14 * position.MaxAbsComponent());

    /// <summary>
    /// Free distances at which what was touched still holds a mover: more than <see cref="TouchTolerance"/>, so that one which lies on
    /// several edges is not passed from one to the next by the curve of its way.
    /// </summary>
    public double ContactSlop(Vector position) => (1e-6 * _radius) + (1e-14 * position.MaxAbsComponent());

    /// <summary>No more than the free distance at a place; nothing above a limit is looked for.</summary>
    public double FreeDistance(Vector position, double maxDistance)
    {
        if (_safeDistance.LowerBoundAt(position) - _radius >= maxDistance)
        {
            return Math.Min(maxDistance, FreeDistanceToBodies(position, maxDistance));
        }

        return TryFindClosestContact(position, maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;
    }

    /// <summary>Finds what is nearest.</summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="maxDistance">Free distances above are of no interest.</param>
    /// <param name="closestContact">What is nearest.</param>
    /// <returns>False where nothing is so near.</returns>
    public bool TryFindClosestContact(Vector position, double maxDistance, out Contact closestContact)
    {
        var isFound = TryFindClosestBody(position, ref maxDistance, out closestContact);
        // A body that is overlapped by more than the radius hides all surfaces.
        if (_safeDistance.LowerBoundAt(position) - _radius > maxDistance || maxDistance < -_radius)
        {
            return isFound;
        }

        if (TryFindClosestSurface(position, maxDistance, out var surface))
        {
            closestContact = surface;
            return true;
        }

        return isFound;
    }

    /// <summary>Adds all bodies that are touched.</summary>
    public void AddTouchedBodies(Vector position, double tolerance, ContactSet contacts)
    {
        foreach (var candidate in _candidates)
        {
            var contact = CreateBodyContact(candidate, Vector.Zero);
            if (contact.Gap(position) <= tolerance)
            {
                contacts.Add(contact, position);
            }
        }
    }

    /// <summary>Finds the surface nearest to a point.</summary>
    public bool TryFindClosestPoint(Vector point, double maxDistance, out ClosestPoint closest)
    {
        closest = default;
        return _staticObjects is not null && _staticObjects.Collider.TryFindClosest(point, maxDistance, queryContext, out closest, out _);
    }

    /// <summary>The distance of a centre from the nearest surface; nothing above a limit is looked for.</summary>
    public double SurfaceDistance(Vector position, double maxDistance)
    {
        foreach (var sphere in _sphereOffsets)
        {
            maxDistance = _staticObjects is not null
                && _staticObjects.Collider.TryFindClosest(position + sphere, maxDistance, queryContext, out var closest, out _)
                ? closest.Distance
                : maxDistance;
        }

        return maxDistance;
    }

    /// <summary>
    /// Finds where a surface that was touched is nearest now: looked for from half-way to it, where nothing else is as near.
    /// </summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="contact">With a surface, as it was.</param>
    /// <param name="updated">As it is.</param>
    /// <returns>False when the surface is not there any more.</returns>
    public bool TryUpdateContact(Vector position, in Contact contact, out Contact updated)
    {
        updated = contact;
        var halfway = position + contact.SphereOffset - (0.5 * _radius * contact.CachedNormal);
        if (_staticObjects is null || !_staticObjects.Collider.TryFindClosest(halfway, 0.6 * _radius, queryContext, out var closest, out _))
        {
            return false;
        }

        updated = contact with { Point = closest.Point, IsFlat = closest.Feature == TriangleFeature.Interior };
        updated = updated with { CachedNormal = updated.Normal(position) };
        return true;
    }

    /// <summary>Finds the surface that is nearest to a position, and on which side of it that is.</summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="closest">The nearest point, if it is within the radius; its normal looks out of the object.</param>
    /// <param name="isInside">True within a closed solid. Seen from within, the nearest point of a solid is inside of a face.</param>
    /// <returns>False when no surface is within the radius.</returns>
    public bool TryFindSurfaceSide(Vector position, out ClosestPoint closest, out bool isInside)
    {
        (closest, isInside) = (default, false);
        if (_staticObjects is null || !_staticObjects.Collider.TryFindClosest(position, _radius, queryContext, out closest, out var index))
        {
            return false;
        }

        var windingSign = _staticObjects.WindingSign(index);
        closest = windingSign < 0 ? closest with { Normal = -closest.Normal } : closest;
        isInside = windingSign != 0 && closest.Feature == TriangleFeature.Interior
            && Vector.Dot(position - closest.Point, closest.Normal) < 0 && _staticObjects.IsSolid(index);
        return true;
    }

    private double FreeDistanceToBodies(Vector position, double maxDistance) =>
        TryFindClosestBody(position, ref maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;

    private bool TryFindClosestBody(Vector position, ref double maxDistance, out Contact closestContact)
    {
        (closestContact, var isFound) = (default, false);
        foreach (var candidate in _candidates)
        {
            foreach (var sphere in _sphereOffsets)
            {
                isFound |= TryUpdateClosest(CreateBodyContact(candidate, sphere), position, ref maxDistance, ref closestContact);
            }
        }

        if (_character is { } character)
        {
            // As firm as a wall.
            foreach (var sphere in character.SphereOffsets)
            {
                isFound |= TryUpdateClosest(
                    new(character.Position + sphere, _radius + character.Description.Radius, Vector.Zero, -1, false), position,
                    ref maxDistance, ref closestContact);
            }
        }

        return isFound;
    }

    private static bool TryUpdateClosest(in Contact contact, Vector position, ref double maxDistance, ref Contact closestContact)
    {
        var gap = contact.Gap(position);
        if (!(gap <= maxDistance))
        {
            return false;
        }

        (closestContact, maxDistance) = (contact, gap);
        return true;
    }

    private bool TryFindClosestSurface(Vector position, double maxDistance, out Contact closestContact)
    {
        closestContact = default;
        if (_staticObjects is null)
        {
            return false;
        }

        var (isFound, maxCentreDistance) = (false, maxDistance + _radius);
        var searchDistance = maxCentreDistance + _searchMargin;
        foreach (var sphere in _sphereOffsets)
        {
            if (_staticObjects.Collider.TryFindClosest(position + sphere, searchDistance, queryContext, out var closest, out _))
            {
                searchDistance = closest.Distance;
                if (searchDistance <= maxCentreDistance)
                {
                    (closestContact, isFound) = (new(closest.Point, _radius, sphere, -1, closest.Feature == TriangleFeature.Interior),
                        true);
                }
            }
        }

        _safeDistance.Store(position, searchDistance);
        return isFound;
    }

    private Contact CreateBodyContact(int candidate, Vector sphere)
    {
        var other = bodies[candidate];
        return new(other.Position, _radius + other.Radius, sphere, candidate, false);
    }
}
