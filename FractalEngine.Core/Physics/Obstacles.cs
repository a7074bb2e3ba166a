using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Physics;

/// <summary>What one mover can run into: the surfaces of the scene, and those other bodies that are within its reach. Set up anew for each mover and step.</summary>
internal sealed class Obstacles(List<Body> bodies, BodyGrid grid, QueryRecord record)
{
    private readonly List<int> _candidates = new(256);
    private Surfaces? _surfaces;
    private Clearance _clearance = new();
    private Vector[] _spheres = [Vector.Zero];
    private double _radius;
    private double _lookahead;
    private Walker? _walker;

    /// <summary>The numbers of the bodies that may be run into, see <see cref="Collect"/>.</summary>
    public List<int> Candidates => _candidates;

    /// <summary>The mover's radius, scene units.</summary>
    public double Radius => _radius;

    /// <summary>Begins with another mover.</summary>
    /// <param name="surfaces">As its colliders see them; null where there are none.</param>
    /// <param name="spheres">The centres of its spheres beside its position.</param>
    /// <param name="radius">Of the spheres.</param>
    /// <param name="clearance">What is known already of what is near.</param>
    /// <param name="lookahead">How far surfaces are looked for beyond what is asked, so that the next steps need not ask.</param>
    /// <param name="walker">A player who is in the way; null for none.</param>
    public void Begin(Surfaces? surfaces, Vector[] spheres, double radius, Clearance clearance, double lookahead, Walker? walker = null)
    {
        (_surfaces, _spheres, _radius, _clearance, _lookahead, _walker) = (surfaces, spheres, radius, clearance, lookahead, walker);
        _candidates.Clear();
    }

    /// <summary>Looks which other bodies are near a way.</summary>
    /// <param name="motion">The way of the mover.</param>
    /// <param name="time">How long it goes.</param>
    /// <param name="except">The mover's own number, −1 for none.</param>
    public void Collect(in Motion motion, double time, int except)
    {
        _candidates.Clear();
        var box = motion.BoxWithin(time);
        foreach (var sphere in _spheres)
        {
            box = BoundingBox.Union(box, new(box.Minimum + sphere, box.Maximum + sphere));
        }

        // A little more, for what touches.
        grid.Collect(in box, _radius * (1 + 1e-6), except, _candidates);
    }

    /// <summary>What counts as touching: the free distances that rounding can't tell from 0.</summary>
    public double Touch(Vector position) => (1e-9 * _radius) + (1e-14 * position.MaximumComponent());

    /// <summary>
    /// Free distances at which what was touched still holds a mover: more than <see cref="Touch"/>, so that one which lies on several edges is not passed
    /// from one to the next by the curve of its way.
    /// </summary>
    public double Hold(Vector position) => (1e-6 * _radius) + (1e-14 * position.MaximumComponent());

    /// <summary>No more than the free distance at a place; nothing above a limit is looked for.</summary>
    public double FreeDistance(Vector position, double limit)
    {
        if (_clearance.At(position) - _radius >= limit)
        {
            return Math.Min(limit, FreeOfBodies(position, limit));
        }

        return TryFind(position, limit, out var nearest) ? nearest.Gap(position) : limit;
    }

    /// <summary>Finds what is nearest.</summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="within">Free distances above are of no interest.</param>
    /// <param name="nearest">What is nearest.</param>
    /// <returns>False where nothing is so near.</returns>
    public bool TryFind(Vector position, double within, out Contact nearest)
    {
        var isFound = TryFindBody(position, ref within, out nearest);
        // A body that is overlapped by more than the radius hides all surfaces.
        if (_clearance.At(position) - _radius > within || within < -_radius)
        {
            return isFound;
        }

        if (TryFindSurface(position, within, out var surface))
        {
            nearest = surface;
            return true;
        }

        return isFound;
    }

    /// <summary>Adds all bodies that are touched.</summary>
    public void AddTouchedBodies(Vector position, double touch, ContactSet contacts)
    {
        foreach (var candidate in _candidates)
        {
            var contact = ContactWith(candidate, Vector.Zero);
            if (contact.Gap(position) <= touch)
            {
                contacts.Add(contact, position);
            }
        }
    }

    /// <summary>Finds the surface nearest to a point.</summary>
    public bool TryFindFace(Vector point, double within, out ClosestPoint closest)
    {
        closest = default;
        return _surfaces is not null && _surfaces.Collider.TryFindClosest(point, within, record, out closest, out _);
    }

    /// <summary>The distance of a centre from the nearest surface; nothing above a limit is looked for.</summary>
    public double SurfaceDistance(Vector position, double limit)
    {
        foreach (var sphere in _spheres)
        {
            limit = _surfaces is not null && _surfaces.Collider.TryFindClosest(position + sphere, limit, record, out var closest, out _) ? closest.Distance : limit;
        }

        return limit;
    }

    /// <summary>Finds where a surface that was touched is nearest now: looked for from half-way to it, where nothing else is as near.</summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="contact">With a surface, as it was.</param>
    /// <param name="followed">As it is.</param>
    /// <returns>False when the surface is not there any more.</returns>
    public bool TryFollow(Vector position, in Contact contact, out Contact followed)
    {
        followed = contact;
        var halfway = position + contact.Offset - (0.5 * _radius * contact.Direction);
        if (_surfaces is null || !_surfaces.Collider.TryFindClosest(halfway, 0.6 * _radius, record, out var closest, out _))
        {
            return false;
        }

        followed = contact with { Point = closest.Point, IsFlat = closest.Feature == FaceFeature.Interior };
        followed = followed with { Direction = followed.Normal(position) };
        return true;
    }

    /// <summary>Finds the surface that is nearest to a position, and on which side of it that is.</summary>
    /// <param name="position">Of the mover.</param>
    /// <param name="closest">The nearest point, if it is within the radius; its normal looks out of the object.</param>
    /// <param name="isBehind">True within a closed solid. Seen from within, the nearest point of a solid is inside of a face.</param>
    /// <returns>False when no surface is within the radius.</returns>
    public bool TryFindSide(Vector position, out ClosestPoint closest, out bool isBehind)
    {
        (closest, isBehind) = (default, false);
        if (_surfaces is null || !_surfaces.Collider.TryFindClosest(position, _radius, record, out closest, out var index))
        {
            return false;
        }

        var orientation = _surfaces.Orientation(index);
        closest = orientation < 0 ? closest with { Normal = -closest.Normal } : closest;
        isBehind = orientation != 0 && closest.Feature == FaceFeature.Interior && Vector.Dot(position - closest.Point, closest.Normal) < 0 && _surfaces.IsSolid(index);
        return true;
    }

    private double FreeOfBodies(Vector position, double limit) =>
        TryFindBody(position, ref limit, out var nearest) ? nearest.Gap(position) : limit;

    private bool TryFindBody(Vector position, ref double within, out Contact nearest)
    {
        (nearest, var isFound) = (default, false);
        foreach (var candidate in _candidates)
        {
            foreach (var sphere in _spheres)
            {
                isFound |= IsNearer(ContactWith(candidate, sphere), position, ref within, ref nearest);
            }
        }

        if (_walker is { } walker)
        {
            // As firm as a wall.
            foreach (var sphere in walker.Spheres)
            {
                isFound |= IsNearer(new(walker.Position + sphere, _radius + walker.Description.Radius, Vector.Zero, -1, false), position, ref within, ref nearest);
            }
        }

        return isFound;
    }

    private static bool IsNearer(in Contact contact, Vector position, ref double within, ref Contact nearest)
    {
        var gap = contact.Gap(position);
        if (!(gap <= within))
        {
            return false;
        }

        (nearest, within) = (contact, gap);
        return true;
    }

    private bool TryFindSurface(Vector position, double within, out Contact nearest)
    {
        nearest = default;
        if (_surfaces is null)
        {
            return false;
        }

        var (isFound, limit) = (false, within + _radius);
        var distance = limit + _lookahead;
        foreach (var sphere in _spheres)
        {
            if (_surfaces.Collider.TryFindClosest(position + sphere, distance, record, out var closest, out _))
            {
                distance = closest.Distance;
                if (distance <= limit)
                {
                    (nearest, isFound) = (new(closest.Point, _radius, sphere, -1, closest.Feature == FaceFeature.Interior), true);
                }
            }
        }

        _clearance.Learn(position, distance);
        return isFound;
    }

    private Contact ContactWith(int candidate, Vector sphere)
    {
        var other = bodies[candidate];
        return new(other.Position, _radius + other.Radius, sphere, candidate, false);
    }
}
