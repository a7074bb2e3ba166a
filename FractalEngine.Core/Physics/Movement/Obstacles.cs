using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;
using FractalEngine.Core.Queries;

namespace FractalEngine.Core.Physics.Movement;

/// <summary>
/// Everything that one mover can collide with: static surfaces, nearby bodies and the character. Set up anew for each mover and step. A
/// mover is one sphere, or several at fixed offsets from its position.
/// </summary>
internal sealed class Obstacles(
    List<Body> bodies, NearbyBodies nearbyBodies, QueryContext queryContext, KinematicSet kinematics, BodySurfaces bodySurfaces)
{
    // Relative to the radius: so far from where a query was made, its result is as good as another one.
    private const double NegligibleDistance = 0.01;

    // Relative to the radius: where from the centre towards a contact the search for its present closest point begins, and how far it goes.
    private const double UpdateDepth = 0.5;
    private const double UpdateSearchRadius = 0.6;

    // Relative to the combined radius: a gap within it needs no other closest point.
    private const double GapTolerance = 1e-13;

    private readonly List<int> _candidates = [];
    private StaticColliders? _staticColliders;
    private SafeDistance _safeDistance = new();
    private Vector[] _sphereOffsets = [Vector.Zero];
    private double _radius;
    private double _searchMargin;
    private CharacterController? _character;
    private BoundingBox _clearBox;
    private bool _isClear;

    /// <summary>Radius of the mover's spheres, scene units.</summary>
    public double Radius => _radius;

    /// <summary>Makes room for so many bodies near a mover.</summary>
    public void Reserve(int bodyCount) => _candidates.EnsureCapacity(bodyCount);

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
        _isClear = false;
    }

    /// <summary>Finds out whether the mover, one ball, may meet other bodies on its way, so that searches along it are fast.</summary>
    /// <param name="motion">Its path, unless it meets anything.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="excludedIndex">Index of the mover itself.</param>
    public void PrepareNearbyBodies(in SphereMotion motion, double duration, int excludedIndex)
    {
        _clearBox = motion.SweptBox(duration);
        _isClear = nearbyBodies.Prepare(in _clearBox, _radius * ContactTolerances.NeighbourRadiusFactor, excludedIndex);
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
    public void CollectNearbyBodies(in SphereMotion motion, double duration, int excludedIndex)
    {
        _candidates.Clear();
        var box = duration > 0 ? motion.SweptBox(duration) : new(motion.Start, motion.Start);
        if (_isClear && _clearBox.Contains(in box))
        {
            return;
        }

        foreach (var sphere in _sphereOffsets)
        {
            box = BoundingBox.Union(box, new(box.Minimum + sphere, box.Maximum + sphere));
        }

        nearbyBodies.CollectOverlaps(in box, _radius * ContactTolerances.NeighbourRadiusFactor, excludedIndex, _candidates);
    }

    /// <summary>Drops the collected bodies that something with a layer and a mask does not meet.</summary>
    public void DropBodiesOfOtherLayers(int layer, uint mask)
    {
        for (var i = _candidates.Count - 1; i >= 0; i--)
        {
            var body = bodies[_candidates[i]].Description;
            if (!Layers.CanMeet(layer, mask, body.Layer, body.Mask))
            {
                _candidates.RemoveAt(i);
            }
        }
    }

    /// <summary>Largest gap of the mover that rounding cannot tell from 0, see <see cref="ContactTolerances.Touch"/>.</summary>
    public double TouchTolerance(Vector position) => ContactTolerances.Touch(_radius, position);

    /// <summary>Largest gap at which the mover keeps a contact, see <see cref="ContactTolerances.Slop"/>.</summary>
    public double ContactSlop(Vector position) => ContactTolerances.Slop(_radius, position);

    /// <summary>Lower bound on the free distance at a position, at most a maximum.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest; nothing beyond is searched for.</param>
    /// <param name="sufficientDistance">A bound that is known already will do if it is at least this.</param>
    /// <param name="hasKinematics">False to leave out what moves by itself.</param>
    public double FreeDistance(Vector position, double maxDistance, double sufficientDistance, bool hasKinematics = true)
    {
        var known = _safeDistance.LowerBoundAt(position) - _radius;
        if (known >= sufficientDistance || _safeDistance.IsKnownNear(position, NegligibleDistance * _radius))
        {
            var toBodies = Math.Min(known, maxDistance);
            var distance = Math.Min(
                maxDistance, TryFindClosestBody(position, ref toBodies, out var body) ? body.Gap(position) : toBodies);
            return hasKinematics ? KinematicDistance(position, distance) : distance;
        }

        return TryFindClosestContact(position, maxDistance, out var closest, hasKinematics) ? closest.Gap(position) : maxDistance;
    }

    /// <summary>Free distance from what moves by itself, at most a maximum.</summary>
    public double KinematicDistance(Vector position, double maxDistance) =>
        TryFindNearKinematic(position, maxDistance, out var kinematic) ? kinematic.Gap(position) : maxDistance;

    /// <summary>Finds the closest obstacle, or the one that is overlapped most.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="closestContact">The obstacle, if there is one.</param>
    /// <param name="hasKinematics">False to leave out what moves by itself.</param>
    /// <returns>False where no obstacle is within the distance.</returns>
    public bool TryFindClosestContact(Vector position, double maxDistance, out Contact closestContact, bool hasKinematics = true)
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

        if (hasKinematics && TryFindNearKinematic(position, maxDistance, out var kinematic))
        {
            closestContact = kinematic;
            isFound = true;
        }

        return isFound;
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

        // To bodies, the character is as immovable as a wall.
        var combinedRadius = _radius + character.Description.Radius;
        foreach (var sphere in character.Capsule.SphereOffsets)
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

    private Contact CreateBodyContact(int candidate, int ball, Vector sphere)
    {
        var other = bodies[candidate];
        return new(other.BallCentre(ball), _radius + other.BallRadius(ball), sphere, candidate, IsFlat: false) { BodyBall = (byte)ball };
    }

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

    /// <summary>True where there are objects that move by themselves, or surfaces of bodies.</summary>
    public bool HasKinematics => kinematics.Objects.Count > 0 || !bodySurfaces.IsEmpty;

    /// <summary>Largest speed of the kinematic objects that the mover may meet; 0 where there are none.</summary>
    /// <param name="motion">Path of the mover.</param>
    /// <param name="duration">Seconds that it takes.</param>
    /// <param name="isRelative">True for the speed as the mover sees it at the beginning.</param>
    public double MaxKinematicSpeed(in SphereMotion motion, double duration, bool isRelative = false)
    {
        if (!HasKinematics || _staticColliders is null)
        {
            return 0;
        }

        var reach = 0.0;
        foreach (var sphere in _sphereOffsets)
        {
            reach = Math.Max(reach, sphere.Length());
        }

        return kinematics.MaxSpeedNear(in motion, duration, (_radius * ContactTolerances.NeighbourRadiusFactor) + reach, isRelative);
    }

    /// <summary>Finds the closest kinematic object.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest free distance of interest.</param>
    /// <param name="contact">The surface, if there is one.</param>
    /// <returns>False where none is within the distance.</returns>
    public bool TryFindNearKinematic(Vector position, double maxDistance, out Contact contact)
    {
        contact = default;
        var isFound = false;
        if (!HasKinematics)
        {
            return false;
        }

        ClosestPoint closest = default;
        foreach (var sphere in _sphereOffsets)
        {
            var found = _staticColliders?.FindCloserKinematic(position + sphere, maxDistance + _radius, queryContext, ref closest);
            var maxBodyDistance = found is null ? maxDistance + _radius : closest.Distance;
            found = bodySurfaces.FindCloser(position + sphere, maxBodyDistance, queryContext, ref closest) ?? found;
            if (found is not null)
            {
                contact = CreateSurfaceContact(in closest, sphere, found);
                maxDistance = closest.Distance - _radius;
                isFound = true;
            }
        }

        return isFound;
    }

    private Contact CreateSurfaceContact(in ClosestPoint closest, Vector sphere, KinematicObject? kinematic)
    {
        var point = kinematic?.ToReference(closest.Point) ?? closest.Point;
        return new(point, _radius, sphere, Contact.NoBody, closest.Feature == TriangleFeature.Interior) { Kinematic = kinematic };
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
        if (FindClosestPoint(point, _radius + maxDistance, out var closest) is not { } target
            || closest.Feature != TriangleFeature.Interior)
        {
            return false;
        }

        normal = (point - closest.Point).UnitVectorOrZero();
        var height = Vector.Dot(position - closest.Point, normal);
        contact = CreateSurfaceContact(closest with { Point = position - (height * normal) }, Vector.Zero, target.Kinematic);
        return height > 0 && height <= _radius + maxDistance;
    }

    /// <summary>The body with a surface that is touched; null for a ball, and for what is no body.</summary>
    public Body? BodyOf(in Contact contact) => contact.Kinematic is { Target: var target } ? bodySurfaces.BodyOf(target) : null;

    /// <summary>Finds the object with the surface point closest to a point, whatever the mover.</summary>
    /// <returns>Null where none is within the distance.</returns>
    public StaticObject? FindClosestPoint(Vector point, double maxDistance, out ClosestPoint closest)
    {
        closest = default;
        var found = _staticColliders?.FindClosest(point, maxDistance, queryContext, out closest);
        var maxBodyDistance = found is null ? maxDistance : closest.Distance;
        return bodySurfaces.FindCloser(point, maxBodyDistance, queryContext, ref closest)?.Target ?? found;
    }

    /// <summary>Distance from the closest centre of the mover's spheres to a surface, at most a maximum.</summary>
    /// <param name="position">Position of the mover, world space.</param>
    /// <param name="maxDistance">Largest distance of interest.</param>
    public double SurfaceDistance(Vector position, double maxDistance)
    {
        foreach (var sphere in _sphereOffsets)
        {
            maxDistance = FindClosestPoint(position + sphere, maxDistance, out var closest) is null ? maxDistance : closest.Distance;
        }

        return maxDistance;
    }

    /// <summary>Finds the new closest points of surfaces after a move, and removes contacts that are not touched any more.</summary>
    /// <param name="contacts">Contacts of the mover.</param>
    /// <param name="position">New position of the mover, world space.</param>
    /// <param name="contactSlop">Largest gap of a contact, scene units.</param>
    public void UpdateAfterMove(ContactSet contacts, Vector position, double contactSlop)
    {
        for (var i = contacts.Count - 1; i >= 0; i--)
        {
            ref readonly var contact = ref contacts[i];
            if (!contact.IsBody)
            {
                var isStale = contact.Kinematic is { AngularVelocity: var turn } && turn != Vector.Zero
                    || Math.Abs(contact.Gap(position)) > GapTolerance * contact.CombinedRadius;
                if (isStale && TryUpdateContact(position, in contact, out var updated))
                {
                    contacts.Replace(i, in updated);
                }
            }

            if (contact.Gap(position) > contactSlop)
            {
                contacts.RemoveAt(i);
            }
        }
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
        if (FindClosestPoint(halfway, UpdateSearchRadius * _radius, out var closest) is not { Kinematic: var kinematic })
        {
            return false;
        }

        var isFlat = closest.Feature == TriangleFeature.Interior;
        var point = closest.Point;
        if (isFlat && kinematic is not null)
        {
            // The search began along the normal of before, and the face may have turned since.
            var centre = position + contact.SphereOffset;
            point = centre - (Vector.Dot(centre - point, closest.Normal) * closest.Normal);
        }

        updated = contact with
        {
            FixedPoint = kinematic?.ToReference(point) ?? point,
            Kinematic = kinematic,
            IsFlat = isFlat,
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
        if (FindClosestPoint(position, _radius, out closest) is not { WindingSign: var windingSign } target)
        {
            return false;
        }

        closest = windingSign < 0 ? closest with { Normal = -closest.Normal } : closest;
        isInside = windingSign != 0 && closest.Feature == TriangleFeature.Interior
            && Vector.Dot(position - closest.Point, closest.Normal) < 0 && target.IsSolid;
        return true;
    }

    /// <summary>Finds the closest surface of what moves not by itself, unless that is known.</summary>
    private bool TryFindClosestSurface(Vector position, double maxDistance, out Contact contact)
    {
        contact = default;
        if (_staticColliders is not { } colliders)
        {
            return false;
        }

        var maxCentreDistance = maxDistance + _radius;
        if (_safeDistance.TryRecall(position, out var distance, out var point, out var isFlat))
        {
            contact = new(point, _radius, _sphereOffsets[0], Contact.NoBody, isFlat);
            return distance <= maxCentreDistance;
        }

        distance = maxCentreDistance + _searchMargin;
        var isFound = false;
        foreach (var sphere in _sphereOffsets)
        {
            if (colliders.Scene.TryFindClosest(position + sphere, distance, queryContext, out var closest))
            {
                isFound = true;
                distance = closest.Distance;
                contact = CreateSurfaceContact(in closest, sphere, kinematic: null);
            }
        }

        if (isFound && _sphereOffsets.Length == 1)
        {
            _safeDistance.StoreClosest(position, distance, contact.FixedPoint, contact.IsFlat);
        }
        else
        {
            _safeDistance.Store(position, distance);
        }

        return isFound && distance <= maxCentreDistance;
    }
}
