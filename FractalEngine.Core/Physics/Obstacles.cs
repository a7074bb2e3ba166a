using FractalEngine.Core.Collision;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Character;
using FractalEngine.Core.Physics.Kinematics;

namespace FractalEngine.Core.Physics;

/// <summary>
/// Everything that one mover can collide with: static surfaces, nearby bodies and the character. Set up anew for each mover and step. A
/// mover is one sphere, or several at fixed offsets from its position.
/// </summary>
internal sealed partial class Obstacles(
    List<Body> bodies, NearbyBodies nearbyBodies, QueryContext queryContext, KinematicSet kinematics)
{
    // Room for so many bodies near a mover; beyond it the list grows.
    private const int InitialCandidateCapacity = 256;

    // Of the radius: how far from the centre towards a contact the search for its present closest point begins, and how far it goes.
    private const double UpdateDepth = 0.5;
    private const double UpdateSearchRadius = 0.6;

    private readonly List<int> _candidates = new(InitialCandidateCapacity);
    private StaticColliders? _staticColliders;
    private SafeDistance _safeDistance = new();
    private Vector[] _sphereOffsets = [Vector.Zero];
    private double _radius;
    private double _searchMargin;
    private CharacterController? _character;

    /// <summary>Radius of the mover's spheres, scene units.</summary>
    public double Radius => _radius;

    /// <summary>Sets up another mover.</summary>
    /// <param name="staticColliders">Colliders of the static objects; null where there are none.</param>
    /// <param name="sphereOffsets">Offsets of the mover's spheres from its position.</param>
    /// <param name="radius">Radius of the spheres, scene units.</param>
    /// <param name="safeDistance">What is known of the distance to surfaces; receives what queries find.</param>
    /// <param name="searchMargin">How much farther queries search than asked, so that the next steps need none.</param>
    /// <param name="character">A character that is in the way; null for none.</param>
    public void SetMover(
        StaticColliders? staticColliders, Vector[] sphereOffsets, double radius, SafeDistance safeDistance, double searchMargin,
        CharacterController? character = null)
    {
        _staticColliders = staticColliders;
        _sphereOffsets = sphereOffsets;
        _radius = radius;
        _safeDistance = safeDistance;
        _searchMargin = searchMargin;
        _character = character;
        _candidates.Clear();
    }

    /// <summary>Makes one ball of a compound the mover, whose nearby bodies stay collected.</summary>
    /// <param name="radius">Its radius, scene units.</param>
    /// <param name="safeDistance">What is known of the distance from its centre to surfaces.</param>
    public void SelectBall(double radius, SafeDistance safeDistance)
    {
        _radius = radius;
        _safeDistance = safeDistance;
    }

    /// <summary>Collects the other bodies near a path. Only these are tested until the next call.</summary>
    /// <param name="motion">Path of the mover.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="excludedIndex">Index of the mover itself, or <see cref="Contact.NoBody"/>.</param>
    public void CollectNearbyBodies(in Motion motion, double duration, int excludedIndex)
    {
        _candidates.Clear();
        var box = motion.SweptBox(duration);
        foreach (var sphere in _sphereOffsets)
        {
            box = BoundingBox.Union(box, new(box.Minimum + sphere, box.Maximum + sphere));
        }

        nearbyBodies.CollectOverlaps(in box, _radius * ContactTolerances.NeighbourRadiusFactor, excludedIndex, _candidates);
    }

    /// <summary>Largest gap of the mover that rounding cannot tell from 0, see <see cref="ContactTolerances.Touch"/>.</summary>
    public double TouchTolerance(Vector position) => ContactTolerances.Touch(_radius, position);

    /// <summary>Largest gap at which the mover keeps a contact, see <see cref="ContactTolerances.Slop"/>.</summary>
    public double ContactSlop(Vector position) => ContactTolerances.Slop(_radius, position);

    /// <summary>Lower bound on the free distance at a position, at most a maximum.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest; nothing beyond is searched for.</param>
    public double FreeDistance(Vector position, double maxDistance)
    {
        if (_safeDistance.LowerBoundAt(position) - _radius >= maxDistance)
        {
            var distance = Math.Min(maxDistance, FreeDistanceToBodies(position, maxDistance));
            return TryFindCloserKinematic(position, ref distance, out var kinematic) ? kinematic.Gap(position) : distance;
        }

        return TryFindClosestContact(position, maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;
    }

    /// <summary>Finds the closest obstacle, or the one that is overlapped most.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="closestContact">The obstacle, if there is one.</param>
    /// <returns>False where no obstacle is within the distance.</returns>
    public bool TryFindClosestContact(Vector position, double maxDistance, out Contact closestContact)
    {
        var isFound = TryFindClosestBody(position, ref maxDistance, out closestContact);
        // A body that is overlapped by more than the radius hides all surfaces.
        if (maxDistance < -_radius)
        {
            return isFound;
        }

        if (!(_safeDistance.LowerBoundAt(position) - _radius > maxDistance)
            && TryFindClosestSurface(position, maxDistance, out var surface))
        {
            closestContact = surface;
            maxDistance = surface.Gap(position);
            isFound = true;
        }

        if (TryFindCloserKinematic(position, ref maxDistance, out var kinematic))
        {
            closestContact = kinematic;
            isFound = true;
        }

        return isFound;
    }

    /// <summary>Finds the closest surface.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="contact">The surface, if there is one.</param>
    /// <returns>False where no surface is within the distance.</returns>
    public bool TryFindNearSurface(Vector position, double maxDistance, out Contact contact)
    {
        contact = default;
        return _safeDistance.LowerBoundAt(position) - _radius <= maxDistance && TryFindClosestSurface(position, maxDistance, out contact);
    }

    /// <summary>Finds the face closest to a point, if the mover's sphere is near its plane.</summary>
    /// <param name="point">Where the search begins, world space.</param>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance from the plane of interest.</param>
    /// <param name="contact">The face, with the mover's foot on its plane.</param>
    /// <param name="normal">Unit normal towards the mover.</param>
    public bool TryFindFace(Vector point, Vector position, double maxDistance, out Contact contact, out Vector normal)
    {
        contact = default;
        normal = Vector.Zero;
        if (!TryFindClosestPoint(point, _radius + maxDistance, out var closest, out _, out var kinematic)
            || closest.Feature != TriangleFeature.Interior)
        {
            return false;
        }

        normal = (point - closest.Point).UnitVectorOrZero();
        var height = Vector.Dot(position - closest.Point, normal);
        contact = CreateSurfaceContact(position - (height * normal), Vector.Zero, isFlat: true, kinematic);
        return height > 0 && height <= _radius + maxDistance;
    }

    /// <summary>Adds contacts with all collected bodies that are touched.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="tolerance">Largest gap that counts as touching.</param>
    /// <param name="contacts">Receives the contacts.</param>
    public void AddTouchedBodies(Vector position, double tolerance, ContactSet contacts)
    {
        foreach (var candidate in _candidates)
        {
            for (var ball = 0; ball < bodies[candidate].BallCount; ball++)
            {
                var contact = CreateBodyContact(candidate, ball, Vector.Zero);
                if (contact.Gap(position) <= tolerance)
                {
                    contacts.Add(contact, position);
                }
            }
        }
    }

    /// <summary>Finds the surface point closest to a point, whatever the mover.</summary>
    public bool TryFindClosestPoint(Vector point, double maxDistance, out ClosestPoint closest) =>
        TryFindClosestPoint(point, maxDistance, out closest, out _, out _);

    /// <summary>Distance from the closest centre of the mover's spheres to a surface, at most a maximum.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest distance of interest.</param>
    public double SurfaceDistance(Vector position, double maxDistance)
    {
        foreach (var sphere in _sphereOffsets)
        {
            maxDistance = TryFindClosestPoint(position + sphere, maxDistance, out var closest) ? closest.Distance : maxDistance;
        }

        return maxDistance;
    }

    /// <summary>
    /// Finds the present closest point of a surface that was touched. The search begins half-way between the centre and the old point,
    /// where nothing else is as close.
    /// </summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="contact">Contact with a surface, as it was.</param>
    /// <param name="updated">The contact as it is now.</param>
    /// <returns>False when the surface is not there any more.</returns>
    public bool TryUpdateContact(Vector position, in Contact contact, out Contact updated)
    {
        updated = contact;
        var halfway = position + contact.SphereOffset - (UpdateDepth * _radius * contact.CachedNormal);
        if (!TryFindClosestPoint(halfway, UpdateSearchRadius * _radius, out var closest, out _, out var kinematic))
        {
            return false;
        }

        updated = contact with
        {
            FixedPoint = kinematic?.ToReference(closest.Point) ?? closest.Point,
            Kinematic = kinematic,
            IsFlat = closest.Feature == TriangleFeature.Interior,
        };
        updated = updated with { CachedNormal = updated.Normal(position) };
        return true;
    }

    /// <summary>Finds the surface closest to a position, and the side of it on which the position is.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="closest">The closest point within the radius, with its normal out of the object.</param>
    /// <param name="isInside">True within a closed solid, whose closest point from inside is always interior to a face.</param>
    /// <returns>False when no surface is within the radius.</returns>
    public bool TryFindSurfaceSide(Vector position, out ClosestPoint closest, out bool isInside)
    {
        isInside = false;
        if (!TryFindClosestPoint(position, _radius, out closest, out var index, out _))
        {
            return false;
        }

        var windingSign = _staticColliders!.WindingSign(index);
        closest = windingSign < 0 ? closest with { Normal = -closest.Normal } : closest;
        isInside = windingSign != 0 && closest.Feature == TriangleFeature.Interior
            && Vector.Dot(position - closest.Point, closest.Normal) < 0 && _staticColliders.IsSolid(index);
        return true;
    }

    private bool TryFindClosestPoint(
        Vector point, double maxDistance, out ClosestPoint closest, out int objectIndex, out KinematicObject? kinematic)
    {
        closest = default;
        objectIndex = -1;
        kinematic = null;
        if (_staticColliders is null)
        {
            return false;
        }

        var isFound = _staticColliders.Scene.TryFindClosest(point, maxDistance, queryContext, out closest, out objectIndex);
        maxDistance = isFound ? closest.Distance : maxDistance;
        if (TryFindOnKinematics(point, maxDistance, ref closest, ref kinematic))
        {
            objectIndex = kinematic!.Target.Index;
            isFound = true;
        }

        return isFound;
    }

    private double FreeDistanceToBodies(Vector position, double maxDistance) =>
        TryFindClosestBody(position, ref maxDistance, out var closestContact) ? closestContact.Gap(position) : maxDistance;

    private bool TryFindClosestBody(Vector position, ref double maxDistance, out Contact closestContact)
    {
        closestContact = default;
        var isFound = false;
        foreach (var candidate in _candidates)
        {
            for (var ball = 0; ball < bodies[candidate].BallCount; ball++)
            {
                foreach (var sphere in _sphereOffsets)
                {
                    isFound |= TryUpdateClosest(CreateBodyContact(candidate, ball, sphere), position, ref maxDistance, ref closestContact);
                }
            }
        }

        if (_character is not { } character)
        {
            return isFound;
        }

        // To bodies, the character is as firm as a wall.
        var combinedRadius = _radius + character.Description.Radius;
        foreach (var sphere in character.SphereOffsets)
        {
            var contact = new Contact(character.Position + sphere, combinedRadius, Vector.Zero, Contact.NoBody, IsFlat: false);
            isFound |= TryUpdateClosest(in contact, position, ref maxDistance, ref closestContact);
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

        closestContact = contact;
        maxDistance = gap;
        return true;
    }

    private bool TryFindClosestSurface(Vector position, double maxDistance, out Contact closestContact)
    {
        closestContact = default;
        if (_staticColliders is null)
        {
            return false;
        }

        var maxCentreDistance = maxDistance + _radius;
        return _sphereOffsets.Length == 1
            ? TryFindClosestSurface(position, _sphereOffsets[0], maxCentreDistance, out closestContact)
            : TryFindClosestSurfaceOfMany(position, maxCentreDistance, out closestContact);
    }

    /// <summary>Finds the closest surface of a mover of one sphere, unless that is known.</summary>
    private bool TryFindClosestSurface(Vector position, Vector sphere, double maxCentreDistance, out Contact closestContact)
    {
        if (!_safeDistance.TryRecall(position, out var distance, out var point, out var isFlat))
        {
            distance = maxCentreDistance + _searchMargin;
            if (!TryFindStaticPoint(position + sphere, distance, out var closest))
            {
                closestContact = default;
                _safeDistance.Store(position, distance);
                return false;
            }

            distance = closest.Distance;
            point = closest.Point;
            isFlat = closest.Feature == TriangleFeature.Interior;
            _safeDistance.StoreClosest(position, distance, point, isFlat);
        }

        closestContact = new(point, _radius, sphere, Contact.NoBody, isFlat);
        return distance <= maxCentreDistance;
    }

    private bool TryFindClosestSurfaceOfMany(Vector position, double maxCentreDistance, out Contact closestContact)
    {
        closestContact = default;
        var isFound = false;
        var searchDistance = maxCentreDistance + _searchMargin;
        foreach (var sphere in _sphereOffsets)
        {
            if (TryFindStaticPoint(position + sphere, searchDistance, out var closest))
            {
                searchDistance = closest.Distance;
                if (searchDistance <= maxCentreDistance)
                {
                    closestContact = new(closest.Point, _radius, sphere, Contact.NoBody, closest.Feature == TriangleFeature.Interior);
                    isFound = true;
                }
            }
        }

        _safeDistance.Store(position, searchDistance);
        return isFound;
    }

    private Contact CreateBodyContact(int candidate, int ball, Vector sphere)
    {
        var other = bodies[candidate];
        return new(other.BallCentre(ball), _radius + other.BallRadius(ball), sphere, candidate, IsFlat: false);
    }
}
