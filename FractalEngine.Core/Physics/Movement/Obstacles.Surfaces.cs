using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Bodies;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Physics.Statics;

namespace FractalEngine.Core.Physics.Movement;

/// <content>Where surfaces are.</content>
internal sealed partial class Obstacles
{
    // Relative to the radius: where from the centre towards a contact the search for its present closest point begins, and how far it goes.
    private const double UpdateDepth = 0.5;
    private const double UpdateSearchRadius = 0.6;

    // Relative to the combined radius: a gap within it needs no other closest point.
    private const double GapTolerance = 1e-13;

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

    /// <summary>Finds the new closest points of surfaces after a move, and removes contacts that are not touched any more.</summary>
    /// <param name="contacts">Contacts of the mover.</param>
    /// <param name="position">New position of the mover, world space.</param>
    public void UpdateAfterMove(ContactSet contacts, Vector position)
    {
        var contactSlop = ContactSlop(position);
        for (var i = contacts.Count - 1; i >= 0; i--)
        {
            ref readonly var contact = ref contacts[i];
            if (!contact.IsBody)
            {
                var gap = contact.Gap(position);
                if (Math.Abs(gap) > GapTolerance * contact.CombinedRadius && TryUpdateContact(position, in contact, out var updated))
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

        var isFound = _staticColliders.Scene.TryFindClosest(point, maxDistance, queryContext, out closest);
        objectIndex = queryContext.ObjectIndex;
        maxDistance = isFound ? closest.Distance : maxDistance;
        if (TryFindOnKinematics(point, maxDistance, ref closest, ref kinematic))
        {
            objectIndex = kinematic!.Target.Index;
            isFound = true;
        }

        return isFound;
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
}
